/// \file
/// Internal: decompresses zstd and LZ4 frames, bounded, since a few bytes can unpack to more than any memory.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fusee::measurement {

enum class Packing { none, zstd, lz4 };

struct Unpacked {
  std::string bytes;   ///< all that could be unpacked
  bool whole = false;  ///< false: the data are cut off, damaged, or larger than allowed
};

/// Unpacks frames that follow each other, up to `most` bytes.
Unpacked unpack(Packing packing, std::string_view packed, std::size_t most);

/// True if the bytes begin with the magic number of a zstd frame.
bool is_zstd(std::string_view bytes);

/// The bytes that one file may unpack to: recordings shrink to a tenth or a half, to less than a thousandth only if
/// they were made for it.
class UnpackingLimit {
 public:
  /// Bytes that may be unpacked now, after `packed` further bytes of the file.
  std::size_t after(std::size_t packed);
  void use(std::size_t unpacked) { left_ -= unpacked < left_ ? unpacked : left_; }

 private:
  std::size_t left_ = std::size_t{64} << 20;
};

}  // namespace fusee::measurement
