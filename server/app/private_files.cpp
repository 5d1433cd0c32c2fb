#include "server/app/private_files.h"

#include <utility>

#include "server/http/static_files.h"

namespace semblante {

std::vector<std::string> private_files_in_web_root(const ServeOptions& options) {
  std::vector<std::string> sentences;
  if (options.web_root.empty()) return sentences;
  for (const auto& [option, file] : {std::pair{"--data", options.data}, std::pair{"--tls-key", options.listening.key}})
    if (!file.empty() && http::lies_within(options.web_root, file))
      sentences.push_back(std::string(option) + ": " + file.string() + " lies within --web-root " +
                          options.web_root.string() + ", whose files everybody can read; choose a place outside of it");
  return sentences;
}

}  // namespace semblante
