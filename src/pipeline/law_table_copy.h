/// \file
/// The text of a mechanism file for another folder, with the CSV of law = "table" or law = "torque" next to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"

namespace fusee::pipeline {

/// File name of the table without folder, not that of an output; empty if the law has no table.
std::optional<std::string> law_table_name(const Mechanism& mechanism);

/// Content of the table under that name.
OutputFile law_table_copy(const MechanismFile& file, FileAccess& files);

/// A text that describes `file.mechanism` and finds its law's table in its own folder: the user's text with comments
/// if it describes the mechanism, otherwise (`rewritten`) a new one with every key.
struct DeclaredText {
  std::string text;
  bool rewritten = false;
};
DeclaredText declared_text(const MechanismFile& file, FileAccess& files);

/// That text as mechanism.toml, and the table if there is one.
std::vector<OutputFile> mechanism_files(const MechanismFile& file, FileAccess& files);

/// `text` with the value of pulley.table or pulley.torque_table replaced by the table's file name. `text` must describe
/// `file.mechanism`.
std::string with_table_beside(const std::string& text, const MechanismFile& file, FileAccess& files);

}  // namespace fusee::pipeline
