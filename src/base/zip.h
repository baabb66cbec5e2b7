/// \file
/// Internal: zip archives in memory, the same bytes for the same entries, read without trust.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct zip;

namespace fusee {

struct ZipEntry {
  std::string name;
  std::string_view bytes;  ///< must outlive the call
};

/// An archive of these in this order. Every date is the zero of DOS dates.
std::string zip_bytes(const std::vector<ZipEntry>& entries);

/// An archive that somebody gave us. `bytes` must outlive it.
class ZipArchive {
 public:
  /// InputError of `name` when it is none; `expected` is what it should have been ("a zip archive with a 3MF model").
  ZipArchive(std::string_view bytes, std::string name, const std::string& expected);

  std::size_t size() const;
  std::string name_of(std::size_t entry) const;
  /// A file as a zip of ours holds it: no folder, no link, not encrypted.
  bool is_plain_file(std::size_t entry) const;
  /// Whatever its capitals.
  std::optional<std::size_t> find(const std::string& entry) const;
  /// The bytes of an entry, taken off `budget`: what an entry says of its size proves nothing. InputError, with
  /// `limits` for a person, where they are more.
  std::string unpacked(std::size_t entry, std::uint64_t& budget, const std::string& limits) const;

 private:
  std::string file_;
  std::unique_ptr<zip, void (*)(zip*)> archive_;
};

/// InputError of a place in an archive.
[[noreturn]] void fail_in_entry(const std::string& file, const std::string& entry, std::ptrdiff_t offset,
                                const std::string& message);

}  // namespace fusee
