/// \file
/// Internal: reproducible zip archives in memory, and a reader for untrusted ones.
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

/// An archive of the entries in the given order, all dated 1980-01-01.
std::string zip_bytes(const std::vector<ZipEntry>& entries);

/// An untrusted archive. `bytes` must outlive it.
class ZipArchive {
 public:
  /// Throws InputError for `name` when it is no archive. `expected` names what is expected ("a zip archive with a 3MF
  /// model").
  ZipArchive(std::string_view bytes, std::string name, const std::string& expected);

  std::size_t size() const;
  std::string name_of(std::size_t entry) const;
  /// True for a regular, unencrypted file: no folder and no link.
  bool is_plain_file(std::size_t entry) const;
  /// Index of an entry, by its name in any capitalization.
  std::optional<std::size_t> find(const std::string& entry) const;
  /// The bytes of an entry, subtracted from `budget`. The declared size of an entry is not trusted. Throws InputError
  /// with `limits` when the budget is exceeded.
  std::string unpacked(std::size_t entry, std::uint64_t& budget, const std::string& limits) const;

 private:
  std::string file_;
  std::unique_ptr<zip, void (*)(zip*)> archive_;
};

/// Throws InputError for an archive entry. `offset`: byte in the entry; −1: the whole entry.
[[noreturn]] void fail_in_entry(const std::string& file, const std::string& entry, std::ptrdiff_t offset,
                                const std::string& message);

}  // namespace fusee
