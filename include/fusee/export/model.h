/// \file
/// What `fusee model` leaves behind, as text. The same input gives the same bytes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fusee/base/check.h"
#include "fusee/base/files.h"
#include "fusee/mechanism/file.h"
#include "fusee/model/model.h"

namespace fusee {

/// All that is known of a joint's model.
struct ModelProduct {
  MechanismFile file;   ///< as it was read
  Mechanism mechanism;  ///< as it is
  JointCurves curves;
  std::string compensation;  ///< the file that curves.shown is from; empty: none
  EqualityFit equality;
  EqualityFit line;
  std::optional<TendonModel> tendons;
  std::string without_tendons;  ///< why there is no tendon model
  bool with_polynomial = true;  ///< whether joint.xml is written
  double most_error = 0;        ///< that a simulator's joint may miss, rad
  double most_table_error = 0;  ///< that tables may miss, rad
  JointTable table;
  std::string prefix;  ///< of the names in the header
  std::vector<Check> checks;
  std::vector<std::string> notes;
};

/// A name that C takes at the beginning of others, from what a joint is called.
std::string c_prefix(const std::string& name);

/// MuJoCo: hinges alpha and theta, coupled by a joint equality.
std::string mujoco_joint_xml(const ModelProduct& product);
/// MuJoCo: the same, coupled by a tendon that is wrapped over its pin. product.tendons must be there.
std::string mujoco_tendons_xml(const ModelProduct& product);
/// Joints alpha and theta, the second mimics the first.
std::string joint_urdf(const ModelProduct& product);
/// The same for ros2_control: joint theta, and a transmission from the motor to it.
std::string ros2_control_urdf(const ModelProduct& product);
std::string joint_table_h(const ModelProduct& product);
std::string joint_table_json(const ModelProduct& product);
std::string model_manifest_json(const ModelProduct& product, const std::vector<OutputFile>& outputs);

/// Whether a manifest of fusee names a file with these bytes.
bool names_output(const std::string& manifest, const std::string& name, const std::string& sha256);

/// What was written, read again and held against the joint's curves.
std::vector<Check> check_model(const ModelProduct& product, const std::vector<OutputFile>& outputs);

}  // namespace fusee
