// SPDX-License-Identifier: MIT
#include "relucent/cli/projector_options.h"

#include <memory>

#include "relucent/cli/options.h"

namespace relucent::cli {

void addNetworkOptions(CLI::App* sub, const std::shared_ptr<NetworkOptions>& options) {
  addRepeated(
      sub, "--pjlink", [options](const std::string& text) { options->addresses.push_back(text); },
      "Where a projector is on the network, several times for several: it is switched on and waited for")
      ->type_name("[N=]HOST[:PORT]");
  addRepeated(
      sub, "--pjlink-password-file",
      [options](const std::string& text) { options->passwordFiles.push_back(text); },
      "File whose first line is the PJLink password of projector N, or of all")
      ->type_name("[N=]FILE");
  addNamed<pipeline::WarmUp>(sub, "--warm-up",
                             "What is waited for before measuring: " + listOfNames<pipeline::WarmUp>(),
                             [options](pipeline::WarmUp chosen) { options->warmUp = chosen; })
      ->type_name("WHAT")
      ->default_str("steady");
}

bool NetworkOptions::empty() const {
  return addresses.empty() && passwordFiles.empty() && !warmUp;
}

void NetworkOptions::apply(pipeline::NetworkProjectors& projectors, const pipeline::RigSettings& rig) const {
  for (const std::string& text : addresses) addAddress(projectors, rig, text);
  for (const std::string& text : passwordFiles) {
    const std::size_t equals = text.find('=');
    const auto projector =
        equals == std::string::npos ? std::nullopt : pipeline::projectorNamed(rig, text.substr(0, equals));
    const std::string password = pipeline::passwordFrom(projector ? text.substr(equals + 1) : text);
    if (projectors.addresses.empty()) throw WrongUsage("a password needs a projector: give --pjlink");
    for (auto& [number, address] : projectors.addresses)
      if (!projector || *projector == number) address.password = password;
  }
  if (warmUp) projectors.warmUp = *warmUp;
}

std::function<Command()> addProjectorsOptions(CLI::App* sub) {
  struct Given {
    std::vector<std::string> hosts;
    bool search = false;
    pjlink::SearchSettings where;
    std::string passwordFile;
  };
  auto command = std::make_shared<Projectors>();
  auto given = std::make_shared<Given>();
  auto network = std::make_shared<NetworkOptions>();
  sub->add_option("HOST", given->hosts, "Projectors to ask, HOST or HOST:PORT");
  CLI::Option* calibration =
      sub->add_option("--calibration", command->calibration, "Ask those of this calibration")
          ->type_name("DIR");
  addNetworkOptions(sub, network);
  CLI::Option* forget =
      sub->add_flag("--forget", command->forget, "Forget the addresses that the calibration has");
  sub->add_flag("--search", given->search,
                "Ask all projectors of PJLink class 2 in the networks of this computer");
  addRepeated(
      sub, "--search-in", [given](const std::string& text) { given->where.targets.push_back(text); },
      "Broadcast address of a network to search, or the number of one projector")
      ->type_name("ADDRESS");
  addNamed<pipeline::ProjectorOrder>(
      sub, "--tell", "Tell them first: " + listOfNames<pipeline::ProjectorOrder>(),
      [command](pipeline::ProjectorOrder order) { command->settings.order = order; })
      ->type_name("ORDER");
  sub->add_option("--password-file", given->passwordFile,
                  "File whose first line is the PJLink password of each HOST")
      ->type_name("FILE");
  sub->footer("With --calibration, --pjlink and its companions change what the calibration keeps.");
  return [=] {
    const std::string password =
        given->passwordFile.empty() ? "" : pipeline::passwordFrom(given->passwordFile);
    for (const std::string& host : given->hosts) {
      const std::optional<pjlink::Address> address = pjlink::addressFrom(host);
      if (!address) throw WrongUsage(fmt::format("'{}' is no address: write HOST or HOST:PORT", host));
      command->settings.addresses.push_back(*address);
      command->settings.addresses.back().password = password;
    }
    if (given->search || !given->where.targets.empty()) command->settings.search = given->where;
    command->network = *network;
    if (calibration->count() == 0 && (!network->empty() || forget->count() > 0))
      throw WrongUsage("--pjlink, its companions and --forget need --calibration");
    if (calibration->count() == 0 && given->hosts.empty() && !command->settings.search)
      throw WrongUsage("say which projectors: HOST, --calibration or --search");
    return Command(*command);
  };
}

}  // namespace relucent::cli
