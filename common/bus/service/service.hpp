#pragma once

#include <functional>

#include "inslab/bus/dds/participant.hpp"
#include "inslab/bus/service/service_options.hpp"
#include "inslab/bus/service/writers.hpp"
#include "inslab/data/streams/identity.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::service {

/// What a service's body is given: its scenario, its place on the network, its command line.
class Context {
 public:
  /// Joins the network under `identity`.
  Context(streams::Identity identity, ServiceOptions options, scenario::LoadedScenario scenario);

  const std::string& service() const { return identity_.service; }
  const streams::Identity& identity() const { return identity_; }
  const ServiceOptions& options() const { return options_; }
  const scenario::LoadedScenario& scenario() const { return scenario_; }
  dds::Participant& participant() { return participant_; }
  /// Who may write what this service reads.
  Writers& writers() { return writers_; }
  /// Whether this service may take part in a run: in any, unless it was started for one.
  bool obeys(const RunId& run) const { return identity_.run_id == RunId{} || identity_.run_id == run; }

 private:
  streams::Identity identity_;
  ServiceOptions options_;
  scenario::LoadedScenario scenario_;
  dds::Participant participant_;
  Writers writers_{participant_.peers(), participant_.key(), identity_};
};

/// What this process says of itself, as `service` with what it was given.
streams::Identity identity_of(const std::string& service, const ServiceOptions& options,
                              const scenario::LoadedScenario& scenario);

/// The participant options that the command line asks for.
dds::ParticipantOptions participant_options(const NetworkOptions& network, const std::string& name);
/// The same, announcing who this process is.
dds::ParticipantOptions participant_options(const NetworkOptions& network, const streams::Identity& identity);

/// Runs a service: command line, logging, signals, scenario, participant, body. Errors of the configuration, and that
/// somebody else is there already, are printed and give exit code 2; whatever else the body throws gives 1.
int run_service(const char* name, const char* purpose, const ServiceTraits& traits, int argc, char** argv,
                const std::function<int(Context&)>& body);

}  // namespace inslab::service
