#pragma once

#include <optional>
#include <span>
#include <string_view>

#include <glm/mat4x4.hpp>

#include "core/import/gltf_document.h"
#include "core/types/neck_joints.h"

namespace semblante::import {

/// The joints of neck and head among those of the file's skins: the humanoid bones of VRM (0.x and 1.0) if it has
/// them, else by name (joint_kind). Of several necks ("neck_01", "neck_02") the one farthest from the head counts.
/// `world` is by node, empty for nodes outside the scene. Whatever is wrong there is no fault of the file: such joints
/// are left out. At most 65536 joints are looked at.
NeckJoints find_neck_joints(GltfDocument& document, std::span<const std::optional<glm::dmat4>> world);

/// What a joint is by its name: "Neck", "mixamorig:Neck1", "CC_Base_NeckTwist01", "J_Bip_C_Head", "DEF-head".
/// "HeadTop_End", "head_nub", "Neck_L" are neither.
enum class JointKind { other, neck, head };
JointKind joint_kind(std::string_view name);

}  // namespace semblante::import
