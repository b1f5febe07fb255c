#pragma once

#include <functional>

#include "app/service_options.hpp"
#include "dds/participant.hpp"
#include "scenario/load.hpp"

namespace inslab::app {

/// What a service's body is given: its scenario, its place on the network, its command line.
class Context {
 public:
  Context(std::string service, ServiceOptions options, scenario::LoadedScenario scenario);

  const std::string& service() const { return service_; }
  const ServiceOptions& options() const { return options_; }
  const scenario::LoadedScenario& scenario() const { return scenario_; }
  dds::Participant& participant() { return participant_; }

 private:
  std::string service_;
  ServiceOptions options_;
  scenario::LoadedScenario scenario_;
  dds::Participant participant_;
};

/// The participant options that the command line asks for.
dds::ParticipantOptions participant_options(const NetworkOptions& network, const std::string& name);

/// Runs a service: command line, logging, signals, scenario, participant, body. Errors of the configuration are printed
/// and give exit code 2, whatever else the body throws gives 1.
int run_service(const char* name, const char* purpose, const ServiceTraits& traits, int argc, char** argv,
                const std::function<int(Context&)>& body);

}  // namespace inslab::app
