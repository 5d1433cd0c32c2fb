#include <algorithm>
#include <cstring>
#include <string>
#include <vector>
#include <zlib.h>

#include "clients/runtime/semblante.h"
#include "clients/runtime/sha256.h"
#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/weights_layout.h"
#include "tests/fuzz/runtime/pieces.h"

using namespace semblante;

namespace {

/// Replaces the first SHA-256 behind `part` in the rig, so that a mutated part still matches the hash that names it.
void write_hash(std::string& rig, const char* part, const Sha256& hash) {
  const std::size_t begin = rig.find("\"sha256\":\"", std::min(rig.find(part), rig.size()));
  const std::string hex = to_hex(hash);
  if (begin != std::string::npos && begin + 10 + hex.size() <= rig.size()) rig.replace(begin + 10, hex.size(), hex);
}

/// The artefact `weights` of a header and an INFLATED payload.
std::vector<std::uint8_t> packed_weights(std::span<const std::uint8_t> raw, const Sha256& mesh) {
  namespace layout = weights_layout;
  if (raw.size() < layout::header_bytes) return {raw.begin(), raw.end()};
  const std::size_t payload = raw.size() - layout::header_bytes;
  std::vector<std::uint8_t> bytes(layout::header_bytes + compressBound(payload));
  uLongf packed = bytes.size() - layout::header_bytes;
  compress2(&bytes[layout::header_bytes], &packed, raw.data() + layout::header_bytes, payload, 1);
  bytes.resize(layout::header_bytes + packed);
  std::copy_n(raw.begin(), layout::header_bytes, bytes.begin());
  std::copy(mesh.begin(), mesh.end(), bytes.begin() + layout::at_mesh_sha256);
  byte_io::put_u32(&bytes[layout::at_raw_bytes], static_cast<std::uint32_t>(payload));
  byte_io::put_u32(&bytes[layout::at_packed_bytes], static_cast<std::uint32_t>(packed));
  byte_io::put_u32(&bytes[layout::at_crc], 0);
  byte_io::put_u32(&bytes[layout::at_crc], static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size())));
  return bytes;
}

void pose(semblante_head* head, std::uint8_t seed) {
  const std::size_t numbers = std::size_t{semblante_head_vertex_count(head)} * 3;
  if (semblante_head_face(head) == nullptr || numbers > 3 * 65536) return;
  std::vector<float> positions(numbers);
  std::vector<float> normals(numbers);
  semblante_pose before{};
  for (int turn = 0; turn < 3; ++turn) {
    semblante_frame frame{};
    frame.viseme1 = static_cast<std::uint8_t>(seed % 15);
    frame.viseme_blend = static_cast<std::uint8_t>(turn * 31);
    frame.expression1 = static_cast<std::uint8_t>(seed % 7);
    frame.intensity1 = 63;
    for (int n = 3; n <= SEMBLANTE_FAP_COUNT; ++n)
      frame.fap[n] = static_cast<float>((seed + n * turn * 7) % 256 - 128) * 20;
    must(semblante_head_get_pose(head, &before) == SEMBLANTE_OK);
    must(semblante_head_set_frame(head, &frame) == SEMBLANTE_OK);
    if (turn == 1) static_cast<void>(semblante_head_set_viseme_share(head, 0.5F));
    const semblante_result shown = turn == 0
                                       ? semblante_head_positions(head, positions.data(), numbers)
                                       : semblante_head_update_positions(head, &before, positions.data(), numbers);
    if (shown == SEMBLANTE_OK)
      static_cast<void>(semblante_head_normals(head, positions.data(), normals.data(), numbers));
  }
  std::vector<float> whole(numbers);
  if (semblante_head_positions(head, whole.data(), numbers) != SEMBLANTE_OK) return;
  // What is not written again must be what a whole computation gives.
  must(std::memcmp(whole.data(), positions.data(), numbers * sizeof(float)) == 0);
}

}  // namespace

/// The input, in this order: flags, a number that chooses the poses, the length of `weights` (inflated), the length of
/// the mesh, `weights`, the mesh, rig.json. Bit 0: the mesh is mesh.drc; otherwise it is corners, and the positions
/// follow from their number. Bit 1: no vertices.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Pieces input(data, size);
  const std::uint8_t flags = input.byte();
  const std::uint8_t seed = input.byte();
  const std::uint16_t weights_size = input.word();
  const std::uint16_t mesh_size = input.word();
  const auto raw_weights = input.bytes(weights_size);
  const auto mesh = input.bytes(mesh_size);
  const auto text = input.rest();
  std::string rig(text.begin(), text.end());

  const Sha256 mesh_hash = runtime::sha256(mesh);
  const auto weights = packed_weights(raw_weights, mesh_hash);
  write_hash(rig, "\"mesh\"", mesh_hash);
  write_hash(rig, "\"weights\"", runtime::sha256(weights));

  semblante_package package{};
  package.size = sizeof(package);
  package.weights = weights.data();
  package.weights_size = weights.size();
  package.rig_json = rig.data();
  package.rig_json_size = rig.size();
  std::vector<float> positions;
  std::vector<std::uint32_t> corners;
  if ((flags & 1U) != 0) {
    package.mesh_drc = mesh.data();
    package.mesh_drc_size = mesh.size();
  } else {
    package.vertex_count =
        weights.size() < weights_layout::header_bytes
            ? 1U
            : std::min<std::uint32_t>(byte_io::get_u32(&weights[weights_layout::at_vertex_count]), 65536U);
    positions.resize(std::size_t{package.vertex_count} * 3);
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = static_cast<float>((i * 37 + seed) % 101) * 0.01F;
    for (std::size_t i = 0; i + 5 < mesh.size(); i += 6) {
      for (std::size_t k = 0; k < 6; k += 2)
        corners.push_back(static_cast<std::uint32_t>(mesh[i + k] | mesh[i + k + 1] << 8U));
    }
    package.positions = positions.data();
    package.mesh_sha256 = mesh_hash.data();
    if (!corners.empty()) {
      package.triangles = corners.data();
      package.triangle_count = static_cast<std::uint32_t>(corners.size() / 3);
      package.normals = positions.data();
    }
  }
  semblante_head_options options{};
  options.size = sizeof(options);
  options.flags = (flags & 2U) != 0 ? SEMBLANTE_HEAD_NO_VERTICES : 0;
  options.jaw_takes_lip = flags >> 2U & 1U;
  semblante_head* head = nullptr;
  semblante_error error{};
  const semblante_result made = semblante_head_create(&package, &options, &head, &error);
  must((made == SEMBLANTE_OK) == (head != nullptr));
  must(made == SEMBLANTE_OK || error.message[0] != '\0');
  must(made != SEMBLANTE_INTERNAL);
  if (head != nullptr) pose(head, seed);
  semblante_head_destroy(head);
  return 0;
}
