#pragma once

#include <filesystem>
#include <string>

namespace inslab::dds {

/// The files of one role, by absolute path.
struct SecurityFiles {
  std::filesystem::path authority;    ///< ca.cert.pem: vouches for certificates, governance and permissions
  std::filesystem::path certificate;  ///< ROLE.cert.pem
  std::filesystem::path key;          ///< ROLE.key.pem
  std::filesystem::path governance;   ///< governance.p7s: what is protected, in everybody's words
  std::filesystem::path permissions;  ///< ROLE.permissions.p7s: what this role may do
};

/// Finds and judges the files that deploy/security/make-keys makes in `directory` for `role`. Where one will not do,
/// Fast DDS only says that there is no participant; this says which and why.
///
/// Throws std::runtime_error naming the file and the reason, when
/// - one is missing or cannot be read, or is not what its name says;
/// - the certificate has expired, is not valid yet, or is not of this authority;
/// - the certificate's holder could sign documents in the authority's name;
/// - the private key is not the certificate's, or has a password;
/// - the private key can be read or written by others than its owner, or the authority's certificate written;
/// - governance or permissions were not signed by this authority or changed since, or their XML is damaged;
/// - the governance leaves a part of the protocol unencrypted (SECURITY.md says what that costs);
/// - no permission is for this certificate's subject, or it has expired or is not valid yet.
SecurityFiles check_security_files(const std::filesystem::path& directory, const std::string& role);

}  // namespace inslab::dds
