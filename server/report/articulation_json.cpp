#include "server/report/articulation_json.h"

#include <nlohmann/json.hpp>

namespace semblante {

nlohmann::ordered_json articulation_json(const Articulation& articulation) {
  return {{"value", articulation.value}, {"reason", articulation.reason}};
}

}  // namespace semblante
