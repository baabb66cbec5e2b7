// Writes every pinned output, for inspection, and the hashes: pins FOLDER [RUN...]
//
// The hashes are accepted with: build/release/tests/pins/pins now && cp now/*.sha256 tests/pins/
#include <algorithm>
#include <cstdio>
#include <map>

#include "export/step/step.h"
#include "pins/hashes.h"
#include "pins/runs.h"

namespace fusee::pins {
namespace {

namespace fs = std::filesystem;

void leave(const std::vector<OutputFile>& outputs, const fs::path& folder) {
  for (const OutputFile& file : outputs) {
    fs::create_directories((folder / file.name).parent_path());
    write_file(folder / file.name, file.bytes, true);
  }
}

/// Hash files are written only if all runs are wanted: a file with the hashes of a few runs must not replace the pins.
int run(const fs::path& folder, const std::vector<std::string>& wanted) {
  std::map<std::string, Hashes> lists;
  for (const PinnedRun& one : runs()) {
    if (one.name.rfind(k_step_runs, 0) == 0 && formats::step_missing()) continue;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), one.name) == wanted.end()) continue;
    const std::vector<OutputFile> outputs = one.outputs();
    leave(outputs, folder / one.name);
    lists[hash_file_of(one.name)].merge(hashes_of(one.name, outputs));
    std::printf("%s: %zu files\n", one.name.c_str(), outputs.size());
  }
  if (!wanted.empty()) return 0;
  for (const auto& [name, hashes] : lists) write_file(folder / name, text_of(hashes), true);
  return 0;
}

}  // namespace
}  // namespace fusee::pins

int main(int count, char** words) {
  if (count < 2) {
    std::fputs("usage: pins FOLDER [RUN...]\n", stderr);
    return 2;
  }
  try {
    return fusee::pins::run(words[1], std::vector<std::string>(words + 2, words + count));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pins: %s\n", error.what());
    return 1;
  }
}
