#include "server/app/lan_mode.h"

#include <iostream>
#include <string>

#include "server/access/new_token.h"
#include "server/app/lan.h"
#include "server/app/serve_failure.h"

namespace semblante {

ListenOptions listening_at_home(ListenOptions options, const std::filesystem::path& data) {
  constexpr std::uint16_t usual_port = 8443;
  if (!options.listen.empty() || !options.certificate.empty())
    fail_serve("--lan chooses address and certificate itself; leave out --listen, --tls-cert and --tls-key");
  auto names = network_addresses();
  if (names.empty()) fail_serve("--lan: this machine has no address in a network");
  names.emplace_back("localhost");
  names.emplace_back("127.0.0.1");
  const auto files = self_signed_certificate(data, names);
  options.listen = {"0.0.0.0:" + std::to_string(options.port == ListenOptions{}.port ? usual_port : options.port)};
  options.certificate = files.certificate;
  options.key = files.key;
  return options;
}

void invite(store::TokenStore& tokens, std::uint16_t port) {
  constexpr std::int64_t life = std::int64_t{12} * 3600;  // seconds
  const std::string name = "serve --lan";
  for (const auto& token : tokens.tokens())
    if (token.name == name) tokens.remove_token(token.id);
  const auto made = access::make_token({name, access::Scope::edit, {}, {}, life});
  tokens.add_token(made.record);
  const auto addresses = network_addresses();
  if (addresses.empty()) return;
  // After the # it is not sent with a request: the page takes it from there and forgets it.
  const auto url = url_of({addresses.front(), port, true}, port) + "/#token=" + made.text;
  std::cout << qr_code(url) << url
            << "\nThe browser warns about the certificate, because this machine has signed it itself. The token is "
               "accepted for 12 hours.\n";
}

}  // namespace semblante
