#pragma once

#include <filesystem>
#include <string>

namespace eprosima::fastdds::dds {
class DomainParticipantQos;
}

namespace inslab::dds {

/// Makes a participant take part in DDS Security as `role`, with the files of `directory` that
/// deploy/security/make-keys makes: ca.cert.pem, ROLE.cert.pem, ROLE.key.pem, governance.p7s, ROLE.permissions.p7s.
///
/// Throws std::runtime_error naming the file and the reason when one of them will not do (bus/dds/security_files.hpp).
void set_security(eprosima::fastdds::dds::DomainParticipantQos& qos, const std::filesystem::path& directory,
                  const std::string& role);

}  // namespace inslab::dds
