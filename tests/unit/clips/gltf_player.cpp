#include "tests/unit/clips/gltf_player.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <tiny_gltf.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace semblante::testing {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// An accessor's numbers as they stand.
template <class T>
std::vector<T> numbers(const tinygltf::Model& model, int accessor_index, int component_type) {
  const tinygltf::Accessor& accessor = model.accessors.at(index(accessor_index));
  EXPECT_EQ(accessor.componentType, component_type);
  const tinygltf::BufferView& view = model.bufferViews.at(index(accessor.bufferView));
  EXPECT_EQ(view.byteStride, 0U);
  const auto components = index(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  std::vector<T> out(accessor.count * components);
  const auto& data = model.buffers.at(index(view.buffer)).data;
  EXPECT_LE(accessor.byteOffset + out.size() * sizeof(T), view.byteLength);
  EXPECT_LE(view.byteOffset + view.byteLength, data.size());
  std::memcpy(out.data(), data.data() + view.byteOffset + accessor.byteOffset, out.size() * sizeof(T));
  return out;
}

std::vector<float> floats(const tinygltf::Model& model, int accessor) {
  return numbers<float>(model, accessor, TINYGLTF_COMPONENT_TYPE_FLOAT);
}

/// A LINEAR sampler at `seconds`: held before and after its keys; turns along the shorter arc.
std::vector<float> sample(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler, bool turns,
                          float seconds) {
  EXPECT_EQ(sampler.interpolation, "LINEAR");
  const auto times = floats(model, sampler.input);
  const auto values = floats(model, sampler.output);
  const std::size_t width = values.size() / times.size();
  const auto value = [&](std::size_t key) {
    return std::vector<float>(values.begin() + static_cast<std::ptrdiff_t>(key * width),
                              values.begin() + static_cast<std::ptrdiff_t>((key + 1) * width));
  };
  if (seconds <= times.front()) return value(0);
  if (seconds >= times.back()) return value(times.size() - 1);
  const auto next = index(static_cast<int>(std::upper_bound(times.begin(), times.end(), seconds) - times.begin()));
  const float t = (seconds - times[next - 1]) / (times[next] - times[next - 1]);
  std::vector<float> a = value(next - 1);
  const std::vector<float> b = value(next);
  if (turns) {
    const glm::quat q = glm::slerp(glm::quat(a[3], a[0], a[1], a[2]), glm::quat(b[3], b[0], b[1], b[2]), t);
    return {q.x, q.y, q.z, q.w};
  }
  for (std::size_t i = 0; i < width; ++i) a[i] += t * (b[i] - a[i]);
  return a;
}

}  // namespace

GltfPlayer::GltfPlayer(std::span<const std::uint8_t> glb) : model_(std::make_unique<tinygltf::Model>()) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
                           void*) { return true; },
                        nullptr);
  std::string error;
  std::string warning;
  EXPECT_TRUE(
      loader.LoadBinaryFromMemory(model_.get(), &error, &warning, glb.data(), static_cast<unsigned>(glb.size())))
      << error;
  EXPECT_EQ(warning, "");
  EXPECT_TRUE(model_->extensionsRequired.empty());
  for (const tinygltf::Primitive& primitive : model_->meshes.at(0).primitives) {
    Primitive out;
    out.material = primitive.material;
    const auto positions = floats(*model_, primitive.attributes.at("POSITION"));
    for (std::size_t i = 0; i < positions.size(); i += 3)
      out.positions.emplace_back(positions[i], positions[i + 1], positions[i + 2]);
    out.corners = numbers<std::uint32_t>(*model_, primitive.indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
    while (primitive.attributes.contains("JOINTS_" + std::to_string(out.sets))) ++out.sets;
    out.joints.resize(out.positions.size() * 4 * out.sets);
    out.weights.resize(out.joints.size());
    for (std::size_t set = 0; set < out.sets; ++set) {
      const std::string number = std::to_string(set);
      const auto joints = numbers<std::uint8_t>(*model_, primitive.attributes.at("JOINTS_" + number),
                                                TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE);
      const auto weights = numbers<std::uint16_t>(*model_, primitive.attributes.at("WEIGHTS_" + number),
                                                  TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
      EXPECT_TRUE(model_->accessors[index(primitive.attributes.at("WEIGHTS_" + number))].normalized);
      for (std::size_t i = 0; i < joints.size(); ++i) {
        const std::size_t at = (i / 4 * out.sets + set) * 4 + i % 4;
        out.joints[at] = joints[i];
        out.weights[at] = weights[i];
      }
    }
    primitives_.push_back(std::move(out));
  }
}

GltfPlayer::~GltfPlayer() = default;

std::size_t GltfPlayer::animation_count() const { return model_->animations.size(); }
std::size_t GltfPlayer::channel_count() const { return model_->animations.at(0).channels.size(); }

float GltfPlayer::duration() const {
  float last = 0.0F;
  for (const tinygltf::AnimationSampler& sampler : model_->animations.at(0).samplers)
    last = std::max(last, floats(*model_, sampler.input).back());
  return last;
}

std::string GltfPlayer::extras() const {
  const std::function<nlohmann::json(const tinygltf::Value&)> json = [&](const tinygltf::Value& value) {
    nlohmann::json out;
    if (value.IsObject()) {
      for (const std::string& key : value.Keys()) out[key] = json(value.Get(key));
    } else if (value.IsArray()) {
      out = nlohmann::json::array();
      for (std::size_t i = 0; i < value.ArrayLen(); ++i) out.push_back(json(value.Get(i)));
    } else if (value.IsString()) {
      out = value.Get<std::string>();
    } else if (value.IsInt()) {
      out = value.Get<int>();
    } else if (value.IsNumber()) {
      out = value.Get<double>();
    }
    return out;
  };
  return json(model_->asset.extras).dump();
}

std::vector<std::vector<glm::vec3>> GltfPlayer::at(float seconds, std::size_t sets) const {
  std::vector<tinygltf::Node> nodes = model_->nodes;
  if (!model_->animations.empty()) {
    const tinygltf::Animation& animation = model_->animations[0];
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      const auto value =
          sample(*model_, animation.samplers.at(index(channel.sampler)), channel.target_path == "rotation", seconds);
      const std::vector<double> numbers(value.begin(), value.end());
      tinygltf::Node& node = nodes.at(index(channel.target_node));
      (channel.target_path == "rotation" ? node.rotation
       : channel.target_path == "scale"  ? node.scale
                                         : node.translation) = numbers;
    }
  }
  std::vector<glm::mat4> world(nodes.size(), glm::mat4(0.0F));
  const std::function<void(int, const glm::mat4&)> place = [&](int number, const glm::mat4& parent) {
    const tinygltf::Node& node = nodes.at(index(number));
    glm::mat4 local(1.0F);
    const auto part = [](const std::vector<double>& v, std::size_t i) { return static_cast<float>(v[i]); };
    if (!node.translation.empty()) {
      const auto& t = node.translation;
      local = glm::translate(local, {part(t, 0), part(t, 1), part(t, 2)});
    }
    if (!node.rotation.empty()) {
      const auto& r = node.rotation;
      local *= glm::mat4_cast(glm::quat(part(r, 3), part(r, 0), part(r, 1), part(r, 2)));
    }
    if (!node.scale.empty()) local = glm::scale(local, {part(node.scale, 0), part(node.scale, 1), part(node.scale, 2)});
    world[index(number)] = parent * local;
    for (const int child : node.children) place(child, world[index(number)]);
  };
  for (const int root : model_->scenes.at(0).nodes) place(root, glm::mat4(1.0F));

  const tinygltf::Skin& skin = model_->skins.at(0);
  const auto inverse = floats(*model_, skin.inverseBindMatrices);
  std::vector<glm::mat4> matrices;
  for (std::size_t j = 0; j < skin.joints.size(); ++j)
    matrices.push_back(world[index(skin.joints[j])] * glm::make_mat4(&inverse[j * 16]));

  std::vector<std::vector<glm::vec3>> out;
  for (const Primitive& primitive : primitives_) {
    const std::size_t width = primitive.sets * 4;
    std::vector<glm::vec3> positions;
    for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
      glm::dvec3 sum(0.0);
      double total = 0.0;
      for (std::size_t i = v * width; i < v * width + std::min(sets, primitive.sets) * 4; ++i) {
        const double weight = primitive.weights[i] / 65535.0;
        const glm::mat4& matrix = matrices.at(primitive.joints[i]);
        sum += weight * glm::dvec3(matrix * glm::vec4(primitive.positions[v], 1.0F));
        total += weight;
      }
      positions.emplace_back(sum / total);
    }
    out.push_back(std::move(positions));
  }
  return out;
}

}  // namespace semblante::testing
