#include "base/zip.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <zip.h>

#include <array>

#include "base/text.h"
#include "fusee/base.h"

namespace fusee {
namespace {

void demand_zip(bool done, zip_t* archive, const std::string& step) {
  if (done) return;  // after closing, the archive has no error text
  demand(false, fmt::format("{}: {}", step, archive == nullptr ? "no memory" : zip_strerror(archive)));
}

void add_entry(zip_t* archive, const ZipEntry& entry) {
  constexpr zip_uint16_t k_midnight = 0;
  constexpr zip_uint16_t k_first_of_1980 = (1 << 5) | 1;  // earliest DOS date: month << 5 | day, years from 1980
  zip_source_t* part = zip_source_buffer(archive, entry.bytes.data(), entry.bytes.size(), 0);
  demand_zip(part != nullptr, archive, entry.name);
  const zip_int64_t added = zip_file_add(archive, entry.name.c_str(), part, ZIP_FL_ENC_UTF_8);
  if (added < 0) zip_source_free(part);
  demand_zip(added >= 0, archive, entry.name);
  const auto index = static_cast<zip_uint64_t>(added);
  // DOS date fields: zip_file_set_mtime() would depend on the local time zone.
  demand_zip(zip_file_set_dostime(archive, index, k_midnight, k_first_of_1980, 0) == 0, archive, entry.name);
  // Stored: deflated bytes change from one version of zlib to the next.
  demand_zip(zip_set_file_compression(archive, index, ZIP_CM_STORE, 0) == 0, archive, entry.name);
}

}  // namespace

std::string zip_bytes(const std::vector<ZipEntry>& entries) {
  zip_source_t* source = zip_source_buffer_create(nullptr, 0, 0, nullptr);
  demand(source != nullptr, "zip: no memory");
  zip_source_keep(source);
  const std::unique_ptr<zip_source_t, decltype(&zip_source_free)> keeper(source, &zip_source_free);
  std::unique_ptr<zip_t, decltype(&zip_discard)> archive(zip_open_from_source(source, ZIP_TRUNCATE, nullptr),
                                                         &zip_discard);
  demand_zip(archive != nullptr, nullptr, "zip");
  for (const ZipEntry& entry : entries) add_entry(archive.get(), entry);
  demand_zip(zip_close(archive.get()) == 0, archive.get(), "zip");
  static_cast<void>(archive.release());  // closed
  zip_stat_t stat;
  demand(zip_source_stat(source, &stat) == 0 && zip_source_open(source) == 0, "reading back a zip in memory");
  std::string bytes(stat.size, '\0');
  const zip_int64_t count = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  demand(count == static_cast<zip_int64_t>(bytes.size()), "reading back a zip in memory");
  return bytes;
}

void fail_in_entry(const std::string& file, const std::string& entry, std::ptrdiff_t offset,
                   const std::string& message) {
  const std::string at = offset < 0 ? std::string() : fmt::format(" at byte {}", offset);
  throw InputError(file, fmt::format("{}{}: {}", cleaned_line(entry.substr(0, 200)), at, message));
}

ZipArchive::ZipArchive(std::string_view bytes, std::string name, const std::string& expected)
    : file_(std::move(name)), archive_(nullptr, zip_discard) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source != nullptr) archive_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  if (archive_ != nullptr) return;
  zip_source_free(source);
  throw InputError(file_, fmt::format("expected {}: {}", expected, reason));
}

std::size_t ZipArchive::size() const { return static_cast<std::size_t>(zip_get_num_entries(archive_.get(), 0)); }

std::string ZipArchive::name_of(std::size_t entry) const {
  const char* name = zip_get_name(archive_.get(), entry, ZIP_FL_ENC_RAW);
  return name == nullptr ? std::string() : std::string(name);
}

bool ZipArchive::is_plain_file(std::size_t entry) const {
  zip_stat_t stat;
  zip_uint8_t system = 0;
  zip_uint32_t attributes = 0;
  if (zip_stat_index(archive_.get(), entry, 0, &stat) != 0 ||
      zip_file_get_external_attributes(archive_.get(), entry, 0, &system, &attributes) != 0)
    return false;
  if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 && stat.encryption_method != ZIP_EM_NONE) return false;
  const zip_uint32_t file_type = system == ZIP_OPSYS_UNIX ? (attributes >> 16) & S_IFMT : 0;
  return file_type == 0 || file_type == S_IFREG;  // 0: the archive declares none
}

std::optional<std::size_t> ZipArchive::find(const std::string& entry) const {
  const zip_int64_t index = zip_name_locate(archive_.get(), entry.c_str(), ZIP_FL_NOCASE);
  return index < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(index));
}

std::string ZipArchive::unpacked(std::size_t entry, std::uint64_t& budget, const std::string& limits) const {
  const std::string name = name_of(entry);
  const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> file(zip_fopen_index(archive_.get(), entry, 0), &zip_fclose);
  if (file == nullptr) fail_in_entry(file_, name, -1, zip_strerror(archive_.get()));
  std::string text;
  std::array<char, 65536> chunk;
  zip_int64_t count = 0;
  while ((count = zip_fread(file.get(), chunk.data(), chunk.size())) > 0) {
    const auto size = static_cast<std::uint64_t>(count);
    if (size > budget) fail_in_entry(file_, name, -1, "unpacks to too much; " + limits);
    budget -= size;
    text.append(chunk.data(), size);
  }
  if (count < 0) fail_in_entry(file_, name, static_cast<std::ptrdiff_t>(text.size()), zip_file_strerror(file.get()));
  return text;
}

}  // namespace fusee
