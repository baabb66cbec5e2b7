/// \file
/// Copies the CSV of law = "table" or law = "torque" next to a changed mechanism file.
#pragma once

#include <optional>
#include <string>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"

namespace fusee::pipeline {

/// File name of the table without folder; empty if the law has no table.
std::optional<std::string> law_table_name(const Mechanism& mechanism);

/// Content of the table under that name.
OutputFile law_table_copy(const MechanismFile& file, FileAccess& files);

/// `text` with the value of pulley.table or pulley.torque_table replaced by the table's file name. `text` must describe
/// `file.mechanism`.
std::string with_table_beside(const std::string& text, const MechanismFile& file, FileAccess& files);

}  // namespace fusee::pipeline
