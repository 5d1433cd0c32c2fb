#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "clients/runtime/semblante.h"
#include "core/types/model.h"
#include "core/types/result.h"
#include "core/types/rig.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/rig_document.h"
#include "protocol/http/http_client.h"

namespace semblante::client {

/// The artefacts as received.
struct PackageBytes {
  std::string mesh_drc;
  std::string weights;
  std::string rig_json;
};

/// A face to be animated by frames. Owns the head of the C SDK.
class Face {
 public:
  /// Compares hashes and counts of the three artefacts, decodes them, and makes a head in the neutral pose. Errors:
  /// mismatch (not of one package), and errors of one of the three, named in `where`.
  static Result<Face> create(const PackageBytes& bytes);

  [[nodiscard]] const RigDocument& rig() const { return rig_; }
  /// The neutral mesh with its materials, vertices in decoded order; images come from fetch_images.
  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] Model& model() { return model_; }
  /// PartRole of each vertex, if the package determines it: eyes and tongue by their rigid motion, `rest` for all
  /// others.
  [[nodiscard]] const std::vector<PartRole>& roles() const { return roles_; }
  /// For close-ups; vertices are those of the model.
  [[nodiscard]] FeaturePointSet feature_points() const;
  [[nodiscard]] semblante_head* head() const { return head_.get(); }

  /// Sets the viseme share (Eq. 5) for later frames: that of the header, else that of rig.json.
  void play_by(const Header& header) const;

  /// The vertices in the head's current pose, #V.
  [[nodiscard]] std::vector<glm::vec3> positions() const;

 private:
  struct Destroy {
    void operator()(semblante_head* head) const { semblante_head_destroy(head); }
  };
  Face() = default;
  RigDocument rig_;
  Model model_;
  std::vector<PartRole> roles_;
  std::unique_ptr<semblante_head, Destroy> head_;
};

/// Which level of detail to fetch. At most one of the two; neither: the full mesh.
struct LevelChoice {
  std::optional<std::uint32_t> lod;           ///< by its number; 0: the full mesh
  std::optional<std::uint32_t> max_vertices;  ///< the largest level with no more; the smallest, when all have more
};

/// The three artefacts of a model's newest package. Sizes are bounded by those stated in rig.json. Errors like
/// HttpClient::fetch; too_large when the stated sizes are over a limit.
Result<PackageBytes> fetch_package(const HttpClient& http, std::string_view model, const LevelChoice& level = {});

/// Fetches the images of the face's materials. Missing images are omitted; the returned warnings name them.
std::vector<std::string> fetch_images(const HttpClient& http, Face& face);

/// fetch_package and Face::create; retries once when a new package has replaced the old one in between.
Result<Face> load_face(const HttpClient& http, std::string_view model, const LevelChoice& level = {});

}  // namespace semblante::client
