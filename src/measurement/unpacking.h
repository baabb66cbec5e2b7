/// \file
/// Internal: decompresses zstd and LZ4 frames, bounded, since a few bytes can unpack to more than the memory holds.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fusee::measurement {

enum class Packing { none, zstd, lz4 };

struct UnpackedBytes {
  std::string bytes;   ///< all that could be unpacked
  bool whole = false;  ///< false: the data are cut off, damaged, or larger than allowed
};

/// Unpacks frames that follow each other, up to `most` bytes.
UnpackedBytes unpack(Packing packing, std::string_view packed, std::size_t most);

/// True if the bytes begin with the magic number of a zstd frame.
bool is_zstd(std::string_view bytes);

/// Limit on the bytes that one file may unpack to. Recordings shrink to between a tenth and a half; only files made to
/// exhaust memory shrink to less than a thousandth.
class UnpackingLimit {
 public:
  /// Raises the limit for `packed` further bytes of the file. Returns the bytes that may still be unpacked.
  std::size_t raise_for(std::size_t packed);
  /// Counts bytes as unpacked.
  void use(std::size_t unpacked) { left_ -= unpacked < left_ ? unpacked : left_; }

 private:
  std::size_t left_ = std::size_t{64} << 20;  ///< bytes that may still be unpacked
};

}  // namespace fusee::measurement
