// semblante-train-packed SOURCE_DIR: puts the probabilities trained on all traces into
// protocol/schema/packed_tables.json.
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "tests/bench/coding/training.h"

namespace {

using Json = nlohmann::ordered_json;

/// A table a line, as the file is written by hand.
std::string text_of(const Json& packed) {
  std::string out = "{\n  \"about\": " + packed.at("about").dump() +
                    ",\n  \"references\": " + packed.at("references").dump() + ",\n  \"tables\": [\n";
  std::string separator;
  for (const Json& table : packed.at("tables")) {
    out += separator + "    { \"name\": " + table.at("name").dump() + ", \"doc\": " + table.at("doc").dump() +
           ",\n      \"values\": " + table.at("values").dump() + " }";
    separator = ",\n";
  }
  return out + "\n  ]\n}\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: semblante-train-packed SOURCE_DIR\n", stderr);
    return 2;
  }
  try {
    using namespace semblante;
    const std::string path = std::string(argv[1]) + "/protocol/schema/packed_tables.json";
    Json packed = Json::parse(std::ifstream(path));
    auto traces = bench::samples();
    if (traces.empty()) throw std::runtime_error("SEMBLANTE_SAMPLES_DIR names no folder with the samples");
    for (auto& trace : bench::made_up_traces()) traces.push_back(std::move(trace));
    const PackedTable table = bench::trained(traces);
    std::size_t at = 0;
    for (Json& each : packed.at("tables")) {
      for (Json& value : each.at("values")) value = table.at(at++);
    }
    if (at != table.size()) throw std::runtime_error("other tables than this program was built with");
    std::ofstream file(path, std::ios::binary);
    file << text_of(packed);
    file.close();
    if (!file) throw std::runtime_error("cannot write " + path);
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "semblante-train-packed: %s\n", fault.what());
    return 1;
  }
  return 0;
}
