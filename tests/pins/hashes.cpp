#include "pins/hashes.h"

#include <sstream>

namespace fusee::pins {

std::string hash_file_of(const std::string& run_name) { return run_name.substr(0, run_name.find('/')) + ".sha256"; }

Hashes hashes_of(const std::string& run_name, const std::vector<OutputFile>& outputs) {
  Hashes hashes;
  for (const OutputFile& file : outputs) hashes[run_name + "/" + file.name] = sha256(file.bytes);
  return hashes;
}

std::string text_of(const Hashes& hashes) {
  std::string text;
  for (const auto& [path, hash] : hashes) text += hash + "  " + path + "\n";
  return text;
}

Hashes parse_hashes(std::string_view text) {
  Hashes hashes;
  std::istringstream lines{std::string(text)};
  for (std::string hash, path; lines >> hash >> path;) hashes[path] = hash;
  return hashes;
}

std::vector<std::string> differences(const Hashes& pinned, const Hashes& found) {
  std::vector<std::string> words;
  for (const auto& [path, hash] : found) {
    const auto before = pinned.find(path);
    if (before == pinned.end()) words.push_back(path + " is new");
    if (before != pinned.end() && before->second != hash) words.push_back(path + " changed");
  }
  for (const auto& [path, hash] : pinned) {
    if (found.count(path) == 0) words.push_back(path + " is gone");
  }
  return words;
}

}  // namespace fusee::pins
