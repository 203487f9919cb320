// SPDX-License-Identifier: GPL-3.0-or-later
// A table of things by two coordinates that are known as intervals. Things whose
// coordinates may be equal are found; the caller compares them exactly. For the
// C++ files of this folder.
#ifndef HSR_COMMON_PAPER_CELLS_H
#define HSR_COMMON_PAPER_CELLS_H

#include "common/base/exact.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace hsr {

class Cells {
public:
  explicit Cells(double side) : side_(side) {}

  // Calls each(cell) for the cells that the intervals reach. False, and no call,
  // if they are too many.
  template <class Each>
  bool reach(int sheet, const Safe_interval &u, const Safe_interval &v,
             Each each) const {
    const double u0 = std::floor(u.inf() / side_),
                 u1 = std::floor(u.sup() / side_),
                 v0 = std::floor(v.inf() / side_),
                 v1 = std::floor(v.sup() / side_);
    if (!(std::fabs(u0) < MOST && std::fabs(u1) < MOST &&
          std::fabs(v0) < MOST && std::fabs(v1) < MOST &&
          (u1 - u0 + 1) * (v1 - v0 + 1) <= 64))
      return false;
    for (double i = u0; i <= u1; i++)
      for (double j = v0; j <= v1; j++)
        each(Cell{sheet, int64_t(i), int64_t(j)});
    return true;
  }

  struct Cell {
    int sheet;
    int64_t i, j;
    bool operator==(const Cell &c) const {
      return sheet == c.sheet && i == c.i && j == c.j;
    }
  };
  const std::vector<uint32_t> *at(const Cell &cell) const {
    const auto found = things_.find(cell);
    return found == things_.end() ? nullptr : &found->second;
  }
  void put(const Cell &cell, uint32_t thing) { things_[cell].push_back(thing); }

private:
  static constexpr double MOST = 0x1p60;
  struct Hash {
    size_t operator()(const Cell &c) const {
      uint64_t h = uint64_t(c.i) * 0x9e3779b97f4a7c15u + uint64_t(c.j);
      h = (h ^ h >> 29) * 0xbf58476d1ce4e5b9u + uint64_t(c.sheet);
      return size_t(h ^ h >> 32);
    }
  };
  double side_;
  std::unordered_map<Cell, std::vector<uint32_t>, Hash> things_;
};

} // namespace hsr

#endif
