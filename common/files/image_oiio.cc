// SPDX-License-Identifier: GPL-3.0-or-later
// Image files, through OpenImageIO. This file is hsr-images.so.

#include "common/files/image_library.h"
#include "common/files/srgb.h"
#include "common/files/whole_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <vector>

namespace {

using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

struct Failure {
  enum hsr_status status;
  std::string text;
};

std::string suffix_of(const std::string &path) {
  size_t slash = path.find_last_of('/'), dot = path.find_last_of('.');
  if (dot == std::string::npos || (slash != std::string::npos && dot < slash))
    return "";
  std::string suffix = path.substr(dot);
  for (char &c : suffix)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return suffix;
}

/* What a library says, on one line. Lack of memory shows in errno, which was
 * cleared before the call. */
Failure failure(const std::string &path, std::string text) {
  if (errno == ENOMEM)
    return {HSR_E_NOMEM, "out of memory"};
  std::replace(text.begin(), text.end(), '\n', ' ');
  return {HSR_E_INPUT, path + ": cannot be written: " + text};
}

using Bytes = std::vector<unsigned char>;

void write_bytes(const std::string &path, const Bytes &bytes) {
  hsr_whole_file file;
  hsr_error err;
  enum hsr_status status = hsr_whole_file_open(&file, path.c_str(), &err);
  if (!status) {
    std::fwrite(bytes.data(), 1, bytes.size(), file.stream);
    status = hsr_whole_file_close(&file, HSR_OK, &err);
  }
  if (status)
    throw Failure{status, err.text};
}

/* Pixels of `type` (UNKNOWN: as the spec lays them out) as the bytes of a file.
 * They are made in memory: where a disk is full, libpng does not say so, and
 * libjpeg ends the program. */
Bytes encode(const std::string &path, const ImageSpec &spec, TypeDesc type,
             const void *pixels) {
  const std::string suffix = suffix_of(path);
  if (suffix.empty())
    throw Failure{HSR_E_INPUT,
                  path + ": a picture's name ends in .png, .exr or the like"};
  /* OpenEXR waits for its threads for ever if it has no memory for a task. */
  OIIO::attribute("exr_threads", -1);
  errno = 0;
  std::unique_ptr<ImageOutput> out = ImageOutput::create(suffix.substr(1));
  if (!out) {
    OIIO::geterror(); /* takes the message away */
    if (errno == ENOMEM)
      throw Failure{HSR_E_NOMEM, "out of memory"};
    throw Failure{HSR_E_INPUT,
                  path + ": '" + suffix + "' is not a picture format"};
  }
  out->threads(1);
  errno = 0;
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  bool good = out->set_ioproxy(&memory) && out->open(path, spec) &&
              out->write_image(type, pixels);
  good = out->close() && good;
  if (!good)
    throw failure(path, out->geterror());
  return bytes;
}

/* The same date in every .exr file, which has one anyway: equal pictures make
 * equal files. */
ImageSpec undated(ImageSpec spec) {
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  return spec;
}

void write_file(const std::string &path, const ImageSpec &spec, TypeDesc type,
                const void *pixels) {
  const bool dated = suffix_of(path) == ".exr";
  write_bytes(path, encode(path, dated ? undated(spec) : spec, type, pixels));
}

/* "key=value" lines into the file's metadata. */
void annotate(ImageSpec &spec, const char *text) {
  for (const char *line = text; line && *line;) {
    const char *end = std::strchr(line, '\n');
    const std::string entry(line, end ? size_t(end - line) : std::strlen(line));
    const size_t equals = entry.find('=');
    if (equals != std::string::npos)
      spec.attribute(entry.substr(0, equals), entry.substr(equals + 1));
    line = end ? end + 1 : nullptr;
  }
}

size_t n_pixels(const hsr_picture &picture) {
  return size_t(picture.m) * size_t(picture.n);
}

/* R G B, A where there is an alpha, Z and id where pixels are samples. */
void write_exr(const std::string &path, const hsr_picture &picture,
               const char *text) {
  const size_t floats = 3 + (picture.alpha ? 1 : 0) + (picture.depth ? 1 : 0),
               size = floats + (picture.ids ? 1 : 0);
  ImageSpec spec(picture.m, picture.n, int(size), TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B"};
  if (picture.alpha) {
    spec.channelnames.push_back("A");
    spec.alpha_channel = 3;
  }
  if (picture.depth) {
    spec.z_channel = int(spec.channelnames.size());
    spec.channelnames.push_back("Z");
  }
  spec.channelformats.assign(floats, TypeDesc::FLOAT);
  if (picture.ids) {
    spec.channelnames.push_back("id");
    spec.channelformats.push_back(TypeDesc::UINT32);
  }
  spec.attribute("compression", "zip");
  annotate(spec, text);
  std::vector<uint32_t> pixels(size * n_pixels(picture)); /* bits of floats */
  uint32_t *to = pixels.data();
  const auto put = [&to](float x) { std::memcpy(to++, &x, sizeof x); };
  for (size_t k = 0; k < n_pixels(picture); k++) {
    for (size_t c = 0; c < 3; c++)
      put(picture.rgb[3 * k + c]);
    if (picture.alpha)
      put(picture.alpha[k]);
    if (picture.depth)
      put(picture.depth[k]);
    if (picture.ids)
      *to++ = picture.ids[k];
  }
  write_file(path, spec, TypeDesc::UNKNOWN, pixels.data());
}

unsigned char byte_of(float encoded) {
  return static_cast<unsigned char>(
      std::min(255.0f, std::max(0.0f, encoded * 255 + 0.5f)));
}

/* Colours as 8 bits, sRGB-encoded. */
void write_colours(const std::string &path, const hsr_picture &picture,
                   const char *text) {
  ImageSpec spec(picture.m, picture.n, 3, TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  annotate(spec, text);
  std::vector<unsigned char> bytes(3 * n_pixels(picture));
  for (size_t k = 0; k < bytes.size(); k++)
    bytes[k] = byte_of(hsr_srgb_encode(picture.rgb[k]));
  write_file(path, spec, TypeDesc::UINT8, bytes.data());
}

/* With a fourth channel, by which the colours are divided. */
void write_with_alpha(const std::string &path, const hsr_picture &picture,
                      const char *text) {
  ImageSpec spec(picture.m, picture.n, 4, TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  annotate(spec, text);
  std::vector<unsigned char> bytes(4 * n_pixels(picture));
  for (size_t k = 0; k < n_pixels(picture); k++) {
    const float alpha = picture.alpha[k];
    for (size_t c = 0; c < 3 && alpha > 0; c++)
      bytes[4 * k + c] = byte_of(
          hsr_srgb_encode(std::min(1.0f, picture.rgb[3 * k + c] / alpha)));
    bytes[4 * k + 3] = byte_of(alpha);
  }
  write_file(path, spec, TypeDesc::UINT8, bytes.data());
}

/* As image.h says. */
void write_grey_depths(const std::string &path, int m, int n,
                       const double *depth, const char *text) {
  const size_t size = size_t(m) * size_t(n);
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  for (size_t k = 0; k < size; k++)
    if (std::isfinite(depth[k])) {
      least = std::min(least, depth[k]);
      greatest = std::max(greatest, depth[k]);
    }
  std::vector<uint16_t> grey(size, 0);
  const double range = greatest > least ? greatest - least : 1;
  for (size_t k = 0; k < size; k++)
    if (std::isfinite(depth[k]))
      grey[k] = uint16_t(1 + std::lrint(65534 * ((depth[k] - least) / range)));
  ImageSpec spec(m, n, 1, TypeDesc::UINT16);
  spec.attribute("oiio:ColorSpace", "Linear");
  annotate(spec, text);
  char number[40];
  if (least <= greatest) {
    std::snprintf(number, sizeof number, "%.17g", least);
    spec.attribute("DepthLeast", number);
    std::snprintf(number, sizeof number, "%.17g", greatest);
    spec.attribute("DepthGreatest", number);
  }
  write_file(path, spec, TypeDesc::UINT16, grey.data());
}

/* Logarithmically to 1, over a factor of 256, since work is spread as unevenly
 * as that. */
std::vector<float> to_its_most(int m, int n, const float *work) {
  const size_t size = size_t(m) * size_t(n);
  const float most = *std::max_element(work, work + size);
  std::vector<float> scaled(work, work + size);
  for (float &x : scaled)
    x = most > 0 ? std::log2(1 + 255 * x / most) / 8 : 0;
  return scaled;
}

/* From 0 to 1 through a ramp of even steps to the eye, dark to bright. */
void write_ramp(const std::string &path, int m, int n, const float *x) {
  const size_t size = size_t(m) * size_t(n);
  const OIIO::ImageBuf source(ImageSpec(m, n, 1, TypeDesc::FLOAT),
                              const_cast<float *>(x));
  /* Into memory of our own: where an image that it makes itself finds none,
   * OpenImageIO divides by 0. */
  std::vector<float> rgb(3 * size); /* linear, as OpenImageIO has its ramps */
  OIIO::ImageBuf ramp(ImageSpec(m, n, 3, TypeDesc::FLOAT), rgb.data());
  errno = 0;
  if (!OIIO::ImageBufAlgo::color_map(ramp, source, 0, "inferno", OIIO::ROI(),
                                     1))
    throw failure(path, ramp.geterror());
  hsr_picture picture = {};
  picture.m = m;
  picture.n = n;
  picture.rgb = rgb.data();
  write_colours(path, picture, nullptr);
}

/* Runs `write`, turning whatever it throws into a status. */
template <class Write>
enum hsr_status guarded(const Write &write, struct hsr_error *err) noexcept {
  try {
    write();
    return HSR_OK;
  } catch (const Failure &f) {
    return hsr_fail(err, f.status, "%s", f.text.c_str());
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const std::exception &e) {
    return hsr_fail(err, HSR_E_INTERNAL, "OpenImageIO: %s", e.what());
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "OpenImageIO: failed");
  }
}

enum hsr_status write(const char *path, const struct hsr_picture *picture,
                      const char *text, struct hsr_error *err) {
  return guarded(
      [&] {
        if (suffix_of(path) == ".exr")
          write_exr(path, *picture, text);
        else if (picture->alpha)
          write_with_alpha(path, *picture, text);
        else
          write_colours(path, *picture, text);
      },
      err);
}

enum hsr_status write_depths(const char *path, int m, int n,
                             const double *depth, const char *text,
                             struct hsr_error *err) {
  return guarded([&] { write_grey_depths(path, m, n, depth, text); }, err);
}

enum hsr_status write_bright(const char *path, int m, int n, const float *x,
                             struct hsr_error *err) {
  return guarded([&] { write_ramp(path, m, n, x); }, err);
}

enum hsr_status write_work(const char *path, int m, int n, const float *work,
                           struct hsr_error *err) {
  return guarded(
      [&] {
        if (suffix_of(path) == ".exr") {
          ImageSpec spec(m, n, 1, TypeDesc::FLOAT);
          spec.channelnames = {"Y"};
          write_file(path, spec, TypeDesc::FLOAT, work);
        } else {
          write_ramp(path, m, n, to_its_most(m, n, work).data());
        }
      },
      err);
}

/* --- Reading --- */

Failure unreadable(const std::string &path, std::string text) {
  Failure f = failure(path, std::move(text));
  const size_t at = f.text.find(": cannot be written: ");
  if (at != std::string::npos)
    f.text.replace(at, 21, ": cannot be read: ");
  return f;
}

/* Whether a file can hold a picture of this size: no format here packs a pixel
 * into less than a thousandth of a byte. */
bool can_hold(const std::string &path, const ImageSpec &spec) {
  std::FILE *file = std::fopen(path.c_str(), "rb");
  const bool sought = file && !std::fseek(file, 0, SEEK_END);
  const double size = sought ? double(std::ftell(file)) : 0;
  if (file)
    std::fclose(file);
  return spec.width > 0 && spec.height > 0 && spec.depth <= 1 &&
         spec.nchannels > 0 && spec.nchannels <= 64 &&
         double(spec.width) * spec.height * spec.nchannels <= 1040 * size;
}

/* The channels that are wanted of each pixel; of grey ones, grey. */
void choose(const std::vector<float> &pixels, int n_channels, bool colours,
            bool encoded, float *value) {
  const auto n = size_t(n_channels);
  for (size_t k = 0; k * n < pixels.size(); k++)
    for (size_t c = 0; c < (colours ? 3 : 1); c++) {
      const float v = pixels[k * n + (n < 3 ? 0 : c)];
      *value++ = colours && encoded ? hsr_srgb_decode(v) : v;
    }
}

void read_pixels(const std::string &path, bool colours, uint32_t size[2],
                 float **value) {
  errno = 0;
  std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path);
  if (!in)
    throw unreadable(path, OIIO::geterror());
  in->threads(1);
  const ImageSpec spec = in->spec();
  if (!can_hold(path, spec))
    throw Failure{HSR_E_INPUT,
                  path + ": is too short for the picture that it claims"};
  std::vector<float> pixels(size_t(spec.width) * size_t(spec.height) *
                            size_t(spec.nchannels));
  errno = 0;
  if (!in->read_image(0, 0, 0, spec.nchannels, TypeDesc::FLOAT, pixels.data()))
    throw unreadable(path, in->geterror());
  const size_t n = size_t(spec.width) * size_t(spec.height);
  *value =
      static_cast<float *>(std::malloc(n * (colours ? 3 : 1) * sizeof(float)));
  if (!*value)
    throw std::bad_alloc();
  choose(pixels, spec.nchannels, colours, spec.format != TypeDesc::FLOAT,
         *value);
  size[0] = uint32_t(spec.width);
  size[1] = uint32_t(spec.height);
}

enum hsr_status read(const char *path, bool colours, uint32_t size[2],
                     float **value, struct hsr_error *err) {
  return guarded([&] { read_pixels(path, colours, size, value); }, err);
}

/* The names of a file's channels, for messages. */
std::string channel_names(const ImageSpec &spec) {
  std::string names;
  for (const std::string &name : spec.channelnames)
    names += (names.empty() ? "" : " ") + name;
  return names;
}

/* The type of an array that holds numbers of a type; 0 bytes if there is none. */
hsr_npy array_of(const TypeDesc &type) {
  hsr_npy a = {};
  a.kind = 'u';
  if (type == TypeDesc::UINT8 || type == TypeDesc::UINT16 ||
      type == TypeDesc::UINT32) {
    a.bytes = int(type.size());
  } else if (type == TypeDesc::INT8 || type == TypeDesc::INT16 ||
             type == TypeDesc::INT32) {
    a.kind = 'i';
    a.bytes = int(type.size());
  } else if (type == TypeDesc::HALF || type == TypeDesc::FLOAT) {
    a.kind = 'f';
    a.bytes = 4;
  }
  return a;
}

void read_as_stored(const std::string &path, const char *channel,
                    hsr_npy *numbers) {
  errno = 0;
  ImageSpec raw; /* colours are not multiplied by their opacity */
  raw.attribute("oiio:UnassociatedAlpha", 1);
  std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path, &raw);
  if (!in)
    throw unreadable(path, OIIO::geterror());
  in->threads(1);
  const ImageSpec spec = in->spec();
  if (!can_hold(path, spec))
    throw Failure{HSR_E_INPUT,
                  path + ": is too short for the picture that it claims"};
  if (spec.x != spec.full_x || spec.y != spec.full_y ||
      spec.width != spec.full_width || spec.height != spec.full_height)
    throw Failure{HSR_E_INPUT, path + ": shows only a part of its picture"};
  const int first = channel ? spec.channelindex(channel) : 0;
  const int n = channel ? 1 : spec.nchannels;
  if (first < 0)
    throw Failure{HSR_E_INPUT, path + ": has no channel " + channel + ", but " +
                                   channel_names(spec)};
  const TypeDesc stored = channel ? spec.channelformat(first) : spec.format;
  hsr_npy a = array_of(stored);
  if (!a.bytes)
    throw Failure{HSR_E_INPUT, path + ": numbers of the type " +
                                   stored.c_str() + " cannot be read"};
  a.n_dimensions = channel ? 2 : 3;
  a.size[0] = uint64_t(spec.height);
  a.size[1] = uint64_t(spec.width);
  a.size[2] = channel ? 0 : uint64_t(n);
  const size_t bytes =
      size_t(spec.width) * size_t(spec.height) * size_t(n) * size_t(a.bytes);
  a.data = std::malloc(bytes);
  if (!a.data)
    throw std::bad_alloc();
  *numbers = a;
  errno = 0;
  if (!in->read_image(0, 0, first, first + n,
                      a.kind == 'f' ? TypeDesc(TypeDesc::FLOAT) : stored,
                      a.data))
    throw unreadable(path, in->geterror());
}

enum hsr_status read_numbers(const char *path, const char *channel,
                             struct hsr_npy *numbers, struct hsr_error *err) {
  return guarded([&] { read_as_stored(path, channel, numbers); }, err);
}

/* --- Tiles --- */

/* What a tile holds of a pixel. */
struct Content {
  int channels;
  TypeDesc type;
  size_t size; /* bytes a pixel */
};
Content content_of(int channels) {
  return channels > 1 ? Content{channels, TypeDesc::FLOAT,
                                size_t(channels) * sizeof(float)}
                      : Content{1, TypeDesc::UINT32, sizeof(uint32_t)};
}

/* A window of a picture. */
ImageSpec spec_of_window(const hsr_tile_grid &tiling, const hsr_window &window,
                         const Content &content, const char *text) {
  ImageSpec spec(window.x1 - window.x0, window.y1 - window.y0, content.channels,
                 content.type);
  spec.x = window.x0;
  spec.y = window.y0;
  spec.full_x = spec.full_y = 0;
  spec.full_width = tiling.m;
  spec.full_height = tiling.n;
  spec.tile_width = spec.tile_height = HSR_TILE_GRAIN;
  if (content.channels == 1)
    spec.channelnames = {"id"};
  else if (content.channels == 3)
    spec.channelnames = {"R", "G", "B"};
  else
    spec.channelnames = {"R", "G", "B", "A"};
  /* Of the levels the fastest for ids; it takes half the time of the standard
   * one, and half as many bytes more. */
  spec.attribute("compression", "zip:2");
  annotate(spec, text);
  return undated(spec);
}

enum hsr_status write_tile(const char *path, const struct hsr_tile_grid *tiling,
                           long number, int channels, const void *pixels,
                           const char *text, struct hsr_error *err) {
  return guarded(
      [&] {
        const hsr_window tile = hsr_tile_window(tiling, number);
        const Content content = content_of(channels);
        write_file(path, spec_of_window(*tiling, tile, content, text),
                   content.type, pixels);
      },
      err);
}

/* A tile's file that is no good. */
Failure no_tile(const std::string &path, const std::string &text) {
  Failure f = unreadable(path, text);
  if (f.status == HSR_E_INPUT)
    f.text += "; remove it to have the tile drawn again";
  return f;
}

/* Reads a tile's pixels from its file. */
void read_tile(const std::string &path, const hsr_tile_grid &tiling,
               long number, const Content &content, Bytes &pixels) {
  const hsr_window tile = hsr_tile_window(&tiling, number);
  errno = 0;
  std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path);
  if (!in)
    throw no_tile(path, OIIO::geterror());
  in->threads(1);
  const ImageSpec spec = in->spec();
  if (spec.x != tile.x0 || spec.y != tile.y0 ||
      spec.width != tile.x1 - tile.x0 || spec.height != tile.y1 - tile.y0 ||
      spec.nchannels != content.channels || spec.format != content.type)
    throw no_tile(path, "it is another tile");
  pixels.resize(size_t(spec.width) * size_t(spec.height) * content.size);
  errno = 0;
  if (!in->read_image(0, 0, 0, content.channels, content.type, pixels.data()))
    throw no_tile(path, in->geterror());
}

/* Writes straight into the file `part`, since the whole does not fit in memory.
 * A failure names `path`. */
void join(const std::string &part, const std::string &path,
          const hsr_tile_grid &tiling, const Content &content,
          const char *(*name)(void *whom, long k), void *whom,
          const char *text) {
  OIIO::attribute("exr_threads", -1);
  /* OpenEXR's newer reader: it takes half the time. */
  OIIO::attribute("openexr:core", 1);
  errno = 0;
  std::unique_ptr<ImageOutput> out = ImageOutput::create("exr");
  if (!out)
    throw failure(path, OIIO::geterror());
  out->threads(1);
  ImageSpec whole = spec_of_window(tiling, hsr_window{0, 0, tiling.m, tiling.n},
                                   content, text);
  /* Tiles go to the file as they come; otherwise OpenEXR keeps them in memory
   * until their turn. */
  whole.attribute("openexr:lineOrder", "randomY");
  if (!out->open(part, whole))
    throw failure(path, out->geterror());
  Bytes pixels;
  const long n = hsr_tile_count(&tiling);
  for (long k = 0; k < n; k++) {
    const hsr_window tile = hsr_tile_window(&tiling, k);
    read_tile(name(whom, k), tiling, k, content, pixels);
    errno = 0;
    if (!out->write_tiles(tile.x0, tile.x1, tile.y0, tile.y1, 0, 1,
                          content.type, pixels.data()))
      throw failure(path, out->geterror());
  }
  errno = 0;
  if (!out->close())
    throw failure(path, out->geterror());
}

enum hsr_status join_tiles(const char *path, const struct hsr_tile_grid *tiling,
                           int channels,
                           const char *(*name)(void *whom, long k), void *whom,
                           const char *text, struct hsr_error *err) {
  const std::string part = std::string(path) + ".part";
  enum hsr_status status = guarded(
      [&] {
        join(part, path, *tiling, content_of(channels), name, whom, text);
        if (std::rename(part.c_str(), path))
          throw failure(path, std::strerror(errno));
      },
      err);
  if (status)
    std::remove(part.c_str());
  return status;
}

} // namespace

extern "C" {
extern const struct hsr_image_library hsr_images;
const struct hsr_image_library hsr_images = {
    write, write_depths, write_work, write_bright,
    read,  read_numbers, write_tile, join_tiles};
}
