#include "dds/security.hpp"

#include <openssl/pem.h>
#include <openssl/x509.h>
#include <openssl/x509_vfy.h>

#include <cstdio>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <memory>
#include <stdexcept>

namespace inslab::dds {

namespace {

using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;

Certificate read_certificate(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "r"), &std::fclose);
  Certificate certificate(file ? PEM_read_X509(file.get(), nullptr, nullptr, nullptr) : nullptr, &X509_free);
  if (!certificate) throw std::runtime_error("security: " + path.string() + ": expected a certificate in PEM");
  return certificate;
}

/// Throws unless the authority vouches for the certificate now.
void verify(const std::filesystem::path& authority_path, const std::filesystem::path& certificate_path) {
  const Certificate authority = read_certificate(authority_path);
  const Certificate certificate = read_certificate(certificate_path);
  const std::unique_ptr<X509_STORE, decltype(&X509_STORE_free)> store(X509_STORE_new(), &X509_STORE_free);
  const std::unique_ptr<X509_STORE_CTX, decltype(&X509_STORE_CTX_free)> context(X509_STORE_CTX_new(),
                                                                                &X509_STORE_CTX_free);
  X509_STORE_add_cert(store.get(), authority.get());
  X509_STORE_CTX_init(context.get(), store.get(), certificate.get(), nullptr);
  if (X509_verify_cert(context.get()) == 1) return;
  throw std::runtime_error("security: " + certificate_path.string() + ": " +
                           X509_verify_cert_error_string(X509_STORE_CTX_get_error(context.get())) + " (authority " +
                           authority_path.string() + ")");
}

}  // namespace

void set_security(eprosima::fastdds::dds::DomainParticipantQos& qos, const std::filesystem::path& directory,
                  const std::string& role) {
  const auto existing = [&directory](const std::string& name) {
    const std::filesystem::path path = directory / name;
    if (!std::filesystem::is_regular_file(path)) {
      throw std::runtime_error("security: " + path.string() + " is not there; deploy/security/make-keys makes it");
    }
    return std::filesystem::absolute(path);
  };
  const auto authority = existing("ca.cert.pem");
  const auto certificate = existing(role + ".cert.pem");
  verify(authority, certificate);
  const auto url = [](const std::filesystem::path& path) { return "file://" + path.string(); };
  auto& properties = qos.properties().properties();
  const auto set = [&properties](const char* name, const std::string& value) { properties.emplace_back(name, value); };
  set("dds.sec.auth.plugin", "builtin.PKI-DH");
  set("dds.sec.auth.builtin.PKI-DH.identity_ca", url(authority));
  set("dds.sec.auth.builtin.PKI-DH.identity_certificate", url(certificate));
  set("dds.sec.auth.builtin.PKI-DH.private_key", url(existing(role + ".key.pem")));
  set("dds.sec.access.plugin", "builtin.Access-Permissions");
  set("dds.sec.access.builtin.Access-Permissions.permissions_ca", url(authority));
  set("dds.sec.access.builtin.Access-Permissions.governance", url(existing("governance.p7s")));
  set("dds.sec.access.builtin.Access-Permissions.permissions", url(existing(role + ".permissions.p7s")));
  set("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
}

}  // namespace inslab::dds
