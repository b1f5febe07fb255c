#pragma once

#include <memory>
#include <string>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/service/service_options.hpp"

namespace inslab::client {

/// A client of whatever set is there, with a participant of its own under this name; both go with it.
std::shared_ptr<RunClient> client_of(const service::NetworkOptions& network, const std::string& name);

}  // namespace inslab::client
