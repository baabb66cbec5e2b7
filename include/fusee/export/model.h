/// \file
/// The outputs of `fusee model`, as text. The same input gives the same bytes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fusee/base/check.h"
#include "fusee/base/files.h"
#include "fusee/mechanism/file.h"
#include "fusee/model/model.h"

namespace fusee {

/// The complete model of a joint.
struct ModelProduct {
  MechanismFile file;   ///< as read
  Mechanism mechanism;  ///< the identified mechanism
  JointCurves curves;
  std::string compensation;  ///< source file of curves.sensed; empty: none
  EqualityFit equality;
  EqualityFit line;
  std::optional<TendonModel> tendons;
  std::string without_tendons;  ///< why there is no tendon model
  bool with_polynomial = true;  ///< true if joint.xml is written
  double most_error = 0;        ///< allowed error of a simulator's joint, rad
  double most_table_error = 0;  ///< allowed error of tables, rad
  JointTable table;
  std::string prefix;  ///< prefix of the names in the header
  std::vector<Check> checks;
  std::vector<std::string> notes;
};

/// A valid C prefix derived from the joint's name.
std::string c_prefix(const std::string& name);

/// MuJoCo: hinges alpha and theta, coupled by a joint equality.
std::string mujoco_joint_xml(const ModelProduct& product);
/// MuJoCo: both hinges, coupled by a tendon that is wrapped over its pin. Requires product.tendons.
std::string mujoco_tendons_xml(const ModelProduct& product);
/// Joints alpha and theta; the second one mimics the first.
std::string joint_urdf(const ModelProduct& product);
/// For ros2_control: joint theta, and a transmission from the motor to it.
std::string ros2_control_urdf(const ModelProduct& product);
std::string joint_table_h(const ModelProduct& product);
std::string joint_table_json(const ModelProduct& product);
std::string model_manifest_json(const ModelProduct& product, const std::vector<OutputFile>& outputs);

/// True if a fusee manifest lists a file with these bytes.
bool names_output(const std::string& manifest, const std::string& name, const std::string& sha256);

/// Reads the written files back and compares them with the joint's curves.
std::vector<Check> check_model(const ModelProduct& product, const std::vector<OutputFile>& outputs);

}  // namespace fusee
