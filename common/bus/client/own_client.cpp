#include "inslab/bus/client/own_client.hpp"

#include "inslab/bus/service/service.hpp"

namespace inslab::client {

std::shared_ptr<RunClient> client_of(const service::NetworkOptions& network, const std::string& name) {
  struct Both {
    Both(const service::NetworkOptions& options, const std::string& participant_name)
        : participant(service::participant_options(options, participant_name)), client(participant) {}
    dds::Participant participant;
    RunClient client;
  };
  const auto both = std::make_shared<Both>(network, name);
  return {both, &both->client};
}

}  // namespace inslab::client
