#include "inslab/bus/dds/security.hpp"

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include "inslab/bus/dds/security_files.hpp"

namespace inslab::dds {

void set_security(eprosima::fastdds::dds::DomainParticipantQos& qos, const std::filesystem::path& directory,
                  const std::string& role) {
  const SecurityFiles files = check_security_files(directory, role);
  const auto url = [](const std::filesystem::path& path) { return "file://" + path.string(); };
  auto& properties = qos.properties().properties();
  const auto set = [&properties](const char* name, const std::string& value) { properties.emplace_back(name, value); };
  set("dds.sec.auth.plugin", "builtin.PKI-DH");
  set("dds.sec.auth.builtin.PKI-DH.identity_ca", url(files.authority));
  set("dds.sec.auth.builtin.PKI-DH.identity_certificate", url(files.certificate));
  set("dds.sec.auth.builtin.PKI-DH.private_key", url(files.key));
  set("dds.sec.access.plugin", "builtin.Access-Permissions");
  set("dds.sec.access.builtin.Access-Permissions.permissions_ca", url(files.authority));
  set("dds.sec.access.builtin.Access-Permissions.governance", url(files.governance));
  set("dds.sec.access.builtin.Access-Permissions.permissions", url(files.permissions));
  set("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
}

}  // namespace inslab::dds
