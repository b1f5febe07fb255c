#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "inslab/bus/dds/discovery.hpp"
#include "inslab/bus/service/service_options.hpp"

namespace inslab::client {

/// One thing that was looked at.
struct Finding {
  enum class Grade { Good, Note, Bad };
  Grade grade;
  std::string what;
  std::string cure;  ///< of a bad one
};

/// What was looked at together.
struct Findings {
  std::string title;
  std::vector<Finding> found;

  /// How many want a cure.
  std::size_t to_cure() const;
};

/// For people: the title, and a line or two for each finding.
std::string words_of(const Findings& findings);

/// Variables and files that lead Fast DDS astray; `folder` is where its processes are started.
Findings examine_environment(const std::function<std::string(const char*)>& variable,
                             const std::filesystem::path& folder);

/// The limits in `kernel`, /proc/sys/net/core.
Findings examine_socket_buffers(const std::filesystem::path& kernel);

/// The segments of Fast DDS in `directory`, /dev/shm; `clean` removes those that nobody uses.
Findings examine_shared_memory(const std::filesystem::path& directory, bool clean);

/// Whether CLOCK_REALTIME is synchronised.
Findings examine_clock();

/// Every pair of a writer and a reader of one topic that will not match, once for each reason.
Findings examine_endpoints(const std::string& where, std::size_t participants,
                           const std::vector<dds::Endpoint>& endpoints);

/// The same of who is heard within so many seconds.
Findings examine_network(const service::NetworkOptions& network, double seconds);

}  // namespace inslab::client
