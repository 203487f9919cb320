// SPDX-License-Identifier: GPL-3.0-or-later
// Texts that several threads read: they are cut into blocks at starts of lines.
//
// A reader of blocks throws Refused at the first fault in a block. Then the
// text is read again as one block, so that the message is about the first fault
// in the file, with the right numbers of elements.
#ifndef HSR_COMMON_MESH_BLOCKS_H
#define HSR_COMMON_MESH_BLOCKS_H

#include "common/base/share.h"
#include "common/files/mesh/mesh_file.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <new>
#include <vector>

namespace hsr {

constexpr size_t TEXT_BLOCK = size_t{1} << 16; /* bytes, about */

/* Cuts the text [begin, end) into blocks of about TEXT_BLOCK bytes. Block is a
 * type with members `begin` and `end`. Each block but the first begins with a
 * line for which may_start(line, end) is true. */
template <class Block, class May_start>
std::vector<Block> cut_text(const char *begin, const char *end,
                            const May_start &may_start) {
  std::vector<Block> blocks;
  const auto past_line = [end](const char *at) {
    const char *stop = std::find(at, end, '\n');
    return stop == end ? end : stop + 1;
  };
  blocks.reserve(static_cast<size_t>(end - begin) / TEXT_BLOCK + 1);
  while (begin < end) {
    const size_t size = std::min(TEXT_BLOCK, static_cast<size_t>(end - begin));
    const char *stop = past_line(begin + size);
    while (stop < end && !may_start(stop, end))
      stop = past_line(stop);
    Block block;
    block.begin = begin;
    block.end = begin = stop;
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/* Calls work(block) for all blocks, on at most `threads` threads. If a call
 * throws Refused, blocks that are not begun are left out, and the result is
 * false. Throws std::bad_alloc. */
template <class Block, class Work>
bool share_blocks(int threads, std::vector<Block> &blocks, const Work &work) {
  struct Shared {
    std::vector<Block> &blocks;
    const Work &work;
    std::atomic<bool> good{true}, out_of_memory{false};
  } shared{blocks, work};
  const auto part = [](void *context, uint32_t k, int) {
    Shared &all = *static_cast<Shared *>(context);
    try {
      if (all.good)
        all.work(all.blocks[k]);
    } catch (const Refused &) {
      all.good = false;
    } catch (const std::bad_alloc &) {
      all.out_of_memory = true;
    }
  };
  hsr_share(threads, static_cast<uint32_t>(blocks.size()), part, &shared);
  if (shared.out_of_memory)
    throw std::bad_alloc();
  return shared.good;
}

/* Reads a text on at most `threads` threads: cuts it into blocks, calls
 * prepare(blocks), and then work(block) for each. If prepare returns false or a
 * block is refused, it is done again with the text as one block. Returns the
 * blocks that were read. Throws Refused, std::bad_alloc. */
template <class Block, class May_start, class Prepare, class Work>
std::vector<Block> read_blocks(int threads, const char *begin, const char *end,
                               const May_start &may_start,
                               const Prepare &prepare, const Work &work) {
  if (threads > 1) {
    std::vector<Block> blocks = cut_text<Block>(begin, end, may_start);
    if (blocks.size() > 1 && prepare(blocks) &&
        share_blocks(threads, blocks, work))
      return blocks;
  }
  std::vector<Block> whole(1);
  whole[0].begin = begin;
  whole[0].end = end;
  prepare(whole);
  work(whole[0]);
  return whole;
}

} // namespace hsr

#endif
