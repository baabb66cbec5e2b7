/// \file
/// The text of a mechanism file for another folder, with the CSV of law = "table" or law = "torque" next to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"

namespace fusee::pipeline {

/// File name for a copy of the law's table, without folder. It differs from the names of all outputs. Empty if the law
/// has no table.
std::optional<std::string> law_table_name(const Mechanism& mechanism);

/// A copy of the law's table, named law_table_name().
OutputFile law_table_copy(const MechanismFile& file, FileAccess& files);

/// A text that describes `file.mechanism` and finds its law's table in its own folder: the user's text with comments
/// if it describes the mechanism, otherwise (`rewritten`) a new one with every key.
struct DeclaredText {
  std::string text;
  bool rewritten = false;
};
DeclaredText declared_text(const MechanismFile& file, FileAccess& files);

/// declared_text() as mechanism.toml, and law_table_copy() if the law has a table.
std::vector<OutputFile> mechanism_files(const MechanismFile& file, FileAccess& files);

/// `text` with the value of pulley.table or pulley.torque_table replaced by the table's file name. `text` must describe
/// `file.mechanism`.
std::string with_table_beside(const std::string& text, const MechanismFile& file, FileAccess& files);

}  // namespace fusee::pipeline
