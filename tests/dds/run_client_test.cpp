#include "inslab/bus/client/run_client.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <thread>

#include "inslab/bus/service/service.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::dds {
namespace run_client_test {

using std::chrono::seconds;

template <class Condition>
bool eventually(Condition condition, seconds patience = seconds(20)) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::yield();
  }
  return true;
}

/// Reads every kind of request, as the trajectory server does, and the logger.
struct RequestReaders {
  explicit RequestReaders(Participant& participant) {
    for_each(catalog::ProfileKinds{}, [&](auto kind) {
      using Profile = typename decltype(kind)::type;
      std::get<Reader<Profile>>(readers) = std::make_unique<OpenReader<Profile>>(
          participant, dds::topics::request<Profile>(), [this](const Profile&, const SampleOrigin&) { ++came; });
    });
  }
  bool are_matched() const {
    return std::apply([](const auto&... reader) { return ((reader->matched_writers() > 0) && ...); }, readers);
  }

  template <class Profile>
  using Reader = std::unique_ptr<OpenReader<Profile>>;
  std::atomic<int> came{0};
  Applied<std::tuple, Mapped<Reader, catalog::ProfileKinds>> readers;
};

streams::Identity identity_of(const char* service) {
  streams::Identity identity;
  identity.service = service;
  identity.host = host::host_name();
  identity.process_space = host::process_space();
  identity.pid = host::process_id();
  identity.started_ticks = host::started_ticks(identity.pid).value_or(0);
  return identity;
}

/// On a busy host the server's readers are known some time after the logger's, and after its status.
TEST(RunClient, IsConnectedOnlyOnceTheTrajectoryServerItselfHearsEveryKindOfRequest) {
  service::NetworkOptions network;
  network.domain = 40 + static_cast<std::uint32_t>(getpid() % 150);
  Participant of_logger(service::participant_options(network, identity_of(catalog::kTruthLogger)));
  Participant of_server(service::participant_options(network, identity_of(catalog::kTrajectoryServer)));
  Participant own(service::participant_options(network, "inslab-follow"));
  const RequestReaders logger(of_logger);
  const OpenReader<SimCommand> commands(of_server, dds::topics::sim_command(),
                                        [](const SimCommand&, const SampleOrigin&) {});
  Writer<SimStatus> statuses(of_server, dds::topics::sim_status());
  client::RunClient client(own);
  SimStatus status;
  status.run_id = host::random_run_id();
  ASSERT_TRUE(statuses.write(status));
  ASSERT_TRUE(eventually([&] { return client.status() && logger.are_matched() && commands.matched_writers() > 0; }));
  EXPECT_FALSE(eventually([&] { return client.connected(); }, seconds(2))) << "only the logger hears requests";

  const RequestReaders server(of_server);
  ASSERT_TRUE(eventually([&] { return client.connected(); }));
  ASSERT_TRUE(client.send(catalog::AnyProfile(InstallationProfile())));
  EXPECT_TRUE(eventually([&] { return server.came == 1 && logger.came == 1; }));
}

}  // namespace run_client_test
}  // namespace inslab::dds
