/// \file
/// Laws of publishing, whatever is in or next to the output folder; for the fuzz target and for the unit test with
/// random bytes.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/staging.h"
#include "fusee/base.h"

namespace fusee::testing {

namespace fs = std::filesystem;

/// Kind, permissions and content of everything in a folder, by path.
inline std::map<std::string, std::string> tree_of(const fs::path& folder) {
  std::map<std::string, std::string> tree;
  for (auto it = fs::recursive_directory_iterator(folder); it != fs::recursive_directory_iterator(); ++it) {
    struct stat status {};
    ::lstat(it->path().c_str(), &status);
    std::string content = fmt::format("{:o} ", status.st_mode);
    if (S_ISREG(status.st_mode)) {
      std::ostringstream text;
      text << std::ifstream(it->path(), std::ios::binary).rdbuf();
      content += text.str();
    } else if (S_ISLNK(status.st_mode)) {
      content += fs::read_symlink(it->path()).string();
    }
    tree[it->path().lexically_relative(folder).string()] = content;
  }
  return tree;
}

/// A folder `root/home/out` with leftovers in and next to it, created from bytes: each entry uses four of them.
class OddGround {
 public:
  OddGround(fs::path root, std::string_view bytes) : root_(std::move(root)) {
    for (const char* folder : {"outside/folder", "home/out"}) fs::create_directories(root_ / folder);
    put(root_ / "outside" / "secret", "secret");
    put(root_ / "outside" / "folder" / "secret", "secret too");
    for (std::size_t at = 0; at + 4 <= bytes.size() && at < 400; at += 4) lay(bytes.substr(at, 4));
  }

  fs::path outside() const { return root_ / "outside"; }
  fs::path out() const { return root_ / "home" / "out"; }

 private:
  static void put(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

  /// Parent of an entry: the output folder, its parent, or a leftover in either.
  fs::path ground(unsigned choice) const {
    const std::string beside = staging_key(out(), StagingSite::beside),
                      inside = staging_key(out(), StagingSite::inside);
    const fs::path home = root_ / "home";
    const std::vector<fs::path> grounds = {out(),
                                           home,
                                           home / (".fusee-3999999-" + beside + "-aaaaaa"),
                                           home / (".fusee-3999998-" + beside + "-bbbbbb"),
                                           out() / (".fusee-3999999-" + inside + "-cccccc"),
                                           out() / (".fusee-3999998-" + inside + "-dddddd"),
                                           home / ".fusee-3999999-x",
                                           out() / ".fusee-3999999-x"};
    const fs::path ground = grounds[choice % grounds.size()];
    const std::vector<std::string> parts = {"", "old", "new", "ready", "obsolete"};
    return ground / parts[choice / 16 % parts.size()];
  }

  void lay(std::string_view bytes) const {
    const auto byte = [&bytes](std::size_t at) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[at])); };
    const fs::path folder = ground(byte(0));
    std::error_code ignored;
    fs::create_directories(folder, ignored);
    const std::vector<std::string> names = {"pulley.stl", "manifest.json", "notes.txt",          "mine",        "a\nb",
                                            "\x1b[2J",    "-rf",           ".publishing",        ".fusee-lock", "old",
                                            "new",        "ready",         std::string(200, 'n')};
    const fs::path entry = folder / names[byte(1) % names.size()];
    if (fs::exists(fs::symlink_status(entry, ignored))) return;
    switch (byte(2) % 8) {
      case 0:
        fs::create_directory(entry, ignored);
        break;
      case 1:
        fs::create_symlink(outside() / "folder", entry, ignored);
        break;
      case 2:
        fs::create_symlink(outside() / "secret", entry, ignored);
        break;
      case 3:
        ::mkfifo(entry.c_str(), 0600);
        break;
      case 4:
        put(entry, manifest(byte(3)));
        break;
      default:
        put(entry, std::string(byte(3) % 4, 'x'));
        break;
    }
    // A leftover's folder has the permissions that fusee sets (0700), wider ones, or ones that prevent its removal.
    const mode_t modes[] = {0700, 0700, 0700, 0755, 0500, 0000};
    const fs::path top = folder.filename().string().rfind(".fusee-", 0) == 0 ? folder : folder.parent_path();
    if (top.filename().string().rfind(".fusee-", 0) == 0) ::chmod(top.c_str(), modes[byte(3) % 6]);
  }

  /// A journal of fusee whose names point elsewhere, with the hashes of the files there.
  std::string manifest(unsigned choice) const {
    const std::vector<std::string> files = {"../../outside/secret", (outside() / "secret").string(), "notes.txt",
                                            "pulley.stl"};
    const std::string hash = sha256(choice % 2 == 0 ? "secret" : "xx"), file = files[choice / 2 % files.size()];
    return fmt::format(R"({{"tool":"fusee","outputs":[{{"file":"{}","sha256":"{}"}}],"withdrawn":["{}"]}})", file, hash,
                       file);
  }

  fs::path root_;
};

/// Publishes a set of files. Returns the broken law, or "".
inline std::string broken_publishing_law(const fs::path& root, std::string_view bytes) {
  const OddGround ground(root, bytes);
  const auto outside = tree_of(ground.outside()), all = tree_of(root), before = tree_of(ground.out());
  try {
    read_file(ground.out() / "pulley.stl", 100);
  } catch (const InputError&) {
  }
  OutputFolder output(ground.out(), false);
  try {
    output.claim({"pulley.stl", "manifest.json"});
  } catch (const OutputError&) {
  }
  if (tree_of(root) != all) return "reading and claiming changed something";
  std::vector<Diagnostic> notes;
  bool published = true;
  try {
    output.stage({"pulley.stl", "solid"});
    output.stage({"manifest.json", R"({"tool":"fusee","outputs":[]})"});
    output.publish(notes);
  } catch (const OutputError&) {
    published = false;
  }
  if (tree_of(ground.outside()) != outside) return "something outside changed";
  const auto after = tree_of(ground.out());
  for (const auto& [name, content] : before) {
    const bool is_ours = published && (name == "pulley.stl" || name == "manifest.json");
    const bool is_leftover = name.rfind(".fusee-", 0) == 0;
    const auto found = after.find(name);
    if (!is_ours && !is_leftover && (found == after.end() || found->second != content)) return "lost: " + name;
  }
  return {};
}

}  // namespace fusee::testing
