#include "scene/formats/psd_rows.h"

#include <zlib.h>

#include <cstring>

namespace holomorph {

/// A ZIP stream that gives its bytes in order.
struct PsdRows::Inflater {
  Inflater(const FileBytes& file, size_t place, size_t end) : file(file) {
    stream.next_in = const_cast<Bytef*>(file.data(place, end - place));
    stream.avail_in = static_cast<uInt>(std::min<size_t>(end - place, ~uInt{0}));
    if (inflateInit(&stream) != Z_OK) file.damaged("a channel cannot be unpacked");
  }
  ~Inflater() { inflateEnd(&stream); }

  void read(std::vector<std::uint8_t>& bytes) {
    stream.next_out = bytes.data();
    stream.avail_out = static_cast<uInt>(bytes.size());
    while (stream.avail_out > 0) {
      const int status = inflate(&stream, Z_NO_FLUSH);
      if (status == Z_STREAM_END && stream.avail_out > 0) file.damaged("a channel is too short");
      if (status != Z_OK && status != Z_STREAM_END) file.damaged("a channel cannot be unpacked");
    }
  }

  const FileBytes& file;
  z_stream stream{};
};

PsdPacking packing_of(const FileBytes& file, size_t number) {
  if (number > static_cast<size_t>(PsdPacking::zip_differences))
    file.damaged("its compression is unknown");
  return static_cast<PsdPacking>(number);
}

PsdRows::PsdRows(const FileBytes& file, const PsdSamples& samples)
    : file_(&file), samples_(samples), bytes_(samples.bytes_per_row()), values_(samples.width) {
  file.need(samples.place, samples.end - samples.place);
  const size_t left = samples.end - samples.place;
  switch (samples.packing) {
    case PsdPacking::none:
      if (samples.height > 0 && bytes_.size() > left / samples.height)
        file.damaged("a channel is too short");
      break;
    case PsdPacking::run_lengths:
      file.need(samples.lengths, 2 * samples.height);
      break;
    case PsdPacking::zip:
    case PsdPacking::zip_differences:
      if (samples.depth == 1) file.damaged("its compression is unknown");
      inflater_ = std::make_unique<Inflater>(file, samples.place, samples.end);
  }
}

PsdRows::~PsdRows() = default;
PsdRows::PsdRows(PsdRows&&) noexcept = default;

/// Unpacks a row of run lengths (PackBits).
void PsdRows::unpack(size_t length) {
  const std::uint8_t* from = file_->data(samples_.place, length);
  const size_t width = bytes_.size();
  size_t at = 0;
  for (size_t i = 0; i < length;) {
    const std::uint8_t head = from[i++];
    if (head == 128) continue;
    const bool repeats = head > 128;
    const size_t count = repeats ? 257u - head : head + 1u, taken = repeats ? 1 : count;
    if (taken > length - i || count > width - at) file_->damaged("its rows have the wrong length");
    if (repeats)
      std::memset(&bytes_[at], from[i], count);
    else
      std::memcpy(&bytes_[at], from + i, count);
    at += count;
    i += taken;
  }
  if (at != width) file_->damaged("its rows have the wrong length");
}

/// Unpacks the bytes of the next row.
void PsdRows::advance() {
  switch (samples_.packing) {
    case PsdPacking::none:
      std::memcpy(bytes_.data(), file_->data(samples_.place, bytes_.size()), bytes_.size());
      samples_.place += bytes_.size();
      break;
    case PsdPacking::run_lengths: {
      const size_t length = file_->big(samples_.lengths + 2 * row_, 2);
      if (length > samples_.end - samples_.place) file_->damaged("a channel is too short");
      unpack(length);
      samples_.place += length;
      break;
    }
    case PsdPacking::zip:
    case PsdPacking::zip_differences:
      inflater_->read(bytes_);
  }
  ++row_;
}

void PsdRows::skip(size_t rows) {
  for (; rows > 0; --rows) advance();
}

const std::vector<std::uint16_t>& PsdRows::next() {
  if (values_.empty()) return values_;
  advance();
  const bool differs = samples_.packing == PsdPacking::zip_differences;
  unsigned last = 0;
  for (size_t i = 0; i < values_.size(); ++i) {
    unsigned value = samples_.depth == 16  ? unsigned{bytes_[2 * i]} << 8 | bytes_[2 * i + 1]
                     : samples_.depth == 8 ? bytes_[i]
                     : bytes_[i / 8] & 128 >> i % 8 ? 0
                                                    : 255;
    if (differs) value = (value + last) & (samples_.depth == 16 ? 0xffff : 0xff);
    last = value;
    values_[i] = static_cast<std::uint16_t>(value);
  }
  return values_;
}

}  // namespace holomorph
