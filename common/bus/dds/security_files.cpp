#include "inslab/bus/dds/security_files.hpp"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <openssl/x509_vfy.h>
#include <openssl/x509v3.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <vector>

#include "inslab/bus/dds/file_access.hpp"

namespace inslab::dds {

namespace {

using std::filesystem::path;

template <class T, void (*Free)(T*)>
struct Freed {
  void operator()(T* object) const { Free(object); }
};
void free_bio(BIO* bio) { BIO_free(bio); }

using Certificate = std::unique_ptr<X509, Freed<X509, &X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY, &EVP_PKEY_free>>;
using Store = std::unique_ptr<X509_STORE, Freed<X509_STORE, &X509_STORE_free>>;
using Bio = std::unique_ptr<BIO, Freed<BIO, &free_bio>>;
using Signed = std::unique_ptr<PKCS7, Freed<PKCS7, &PKCS7_free>>;

[[noreturn]] void refuse(const path& file, const std::string& why) {
  throw std::runtime_error("security: " + file.string() + ": " + why);
}

path existing(const path& directory, const std::string& name) {
  const path file = directory / name;
  if (!std::filesystem::is_regular_file(file)) {
    throw std::runtime_error("security: " + file.string() + " is not there; deploy/security/make-keys makes it");
  }
  return std::filesystem::absolute(file);
}

Bio open(const path& file) {
  Bio bio(BIO_new_file(file.c_str(), "r"));
  if (!bio) refuse(file, "cannot be read by this user");
  return bio;
}

Certificate read_certificate(const path& file) {
  Certificate certificate(PEM_read_bio_X509(open(file).get(), nullptr, nullptr, nullptr));
  if (!certificate) refuse(file, "expected a certificate in PEM");
  return certificate;
}

/// Asks nobody at a terminal for a password: there is none for services.
int no_password(char*, int, int, void*) { return 0; }

void check_key(const path& file, X509& certificate, const path& certificate_file) {
  const AccessOfOthers others = access_of_others(file);
  if (others.read || others.write) {
    const char* can = !others.write ? "read" : !others.read ? "written" : "read and written";
    refuse(file, std::string("can be ") + can + " by others than its owner (mode " + mode_text(file) +
                     "): a private key is its owner's alone; make new keys if others may have seen it, else chmod 600");
  }
  const Key key(PEM_read_bio_PrivateKey(open(file).get(), nullptr, &no_password, nullptr));
  if (!key) refuse(file, "expected a private key in PEM, without a password");
  if (X509_check_private_key(&certificate, key.get()) != 1) {
    refuse(file, "is not the key of " + certificate_file.string());
  }
}

/// Throws unless the authority vouches for the certificate now.
void check_certificate(X509_STORE& authority, const path& authority_file, X509& certificate, const path& file) {
  const std::unique_ptr<X509_STORE_CTX, Freed<X509_STORE_CTX, &X509_STORE_CTX_free>> context(X509_STORE_CTX_new());
  X509_STORE_CTX_init(context.get(), &authority, &certificate, nullptr);
  if (X509_verify_cert(context.get()) != 1) {
    refuse(file, std::string(X509_verify_cert_error_string(X509_STORE_CTX_get_error(context.get()))) + " (authority " +
                     authority_file.string() + ")");
  }
  if (X509_check_purpose(&certificate, X509_PURPOSE_SMIME_SIGN, 0) != 0 || X509_check_ca(&certificate) != 0) {
    refuse(file,
           "its holder could sign permissions for itself, which peers would take as the authority's: it comes of an "
           "earlier deploy/security/make-keys; make new keys");
  }
}

/// The text of a document once its signature is found good, judged as Fast DDS does (PKCS #7 in S/MIME).
std::string signed_text(const path& file, X509_STORE& authority, const path& authority_file) {
  BIO* raw_content = nullptr;
  const Signed document(SMIME_read_PKCS7(open(file).get(), &raw_content));
  const Bio content(raw_content);
  if (!document)
    refuse(file, "expected a document signed by the authority (S/MIME); it is damaged or never was signed");
  const Bio text(BIO_new(BIO_s_mem()));
  if (PKCS7_verify(document.get(), nullptr, &authority, content.get(), text.get(), PKCS7_TEXT) != 1) {
    const char* reason = ERR_reason_error_string(ERR_peek_last_error());
    refuse(file, "its signature is not good: the document was changed, or signed by another authority than " +
                     authority_file.string() + " (OpenSSL: " + (reason != nullptr ? reason : "no reason") + ")");
  }
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(text.get(), &bytes);
  return size > 0 ? std::string(bytes, static_cast<std::size_t>(size)) : "";
}

using Element = tinyxml2::XMLElement;

void parse(tinyxml2::XMLDocument& document, const path& file, const std::string& text) {
  // OpenSSL keeps the S/MIME line ends; XML does not care.
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    refuse(file, "its XML is damaged at line " + std::to_string(document.ErrorLineNum()));
  }
}

const Element& child(const Element& parent, const char* name, const path& file) {
  const Element* found = parent.FirstChildElement(name);
  if (found == nullptr) refuse(file, std::string("has no <") + name + "> in <" + parent.Name() + ">");
  return *found;
}

std::string text_of(const Element& parent, const char* name, const path& file) {
  const char* text = child(parent, name, file).GetText();
  return text != nullptr ? text : "";
}

void expect(const Element& parent, const char* name, const std::vector<std::string>& expected, const path& file) {
  const std::string found = text_of(parent, name, file);
  if (std::find(expected.begin(), expected.end(), found) != expected.end()) return;
  refuse(file, std::string(name) + " is '" + found + "'; expected " + expected.front() +
                   ", as deploy/security/make-keys says it now: with less, whoever reaches the network can forge parts "
                   "of the protocol");
}

void check_governance(const path& file, const std::string& text) {
  tinyxml2::XMLDocument document;
  parse(document, file, text);
  const Element* dds = document.FirstChildElement("dds");
  if (dds == nullptr) refuse(file, "has no <dds>");
  const std::vector<std::string> encrypt{"ENCRYPT", "ENCRYPT_WITH_ORIGIN_AUTHENTICATION"};
  const Element* rule = &child(child(*dds, "domain_access_rules", file), "domain_rule", file);
  for (; rule != nullptr; rule = rule->NextSiblingElement("domain_rule")) {
    expect(*rule, "allow_unauthenticated_participants", {"false", "FALSE", "0"}, file);
    expect(*rule, "rtps_protection_kind", encrypt, file);
    expect(*rule, "discovery_protection_kind", encrypt, file);
    expect(*rule, "liveliness_protection_kind", encrypt, file);
    const Element* topic = &child(child(*rule, "topic_access_rules", file), "topic_rule", file);
    for (; topic != nullptr; topic = topic->NextSiblingElement("topic_rule")) {
      expect(*topic, "enable_discovery_protection", {"true", "TRUE", "1"}, file);
    }
  }
}

/// The subject as RFC 2253 writes it, which is how permissions name it.
std::string subject_of(X509& certificate) {
  const Bio text(BIO_new(BIO_s_mem()));
  X509_NAME_print_ex(text.get(), X509_get_subject_name(&certificate), 0, XN_FLAG_RFC2253 & ~ASN1_STRFLGS_ESC_MSB);
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(text.get(), &bytes);
  return size > 0 ? std::string(bytes, static_cast<std::size_t>(size)) : "";
}

/// Without the spaces around commas, in which the two ways of writing a subject differ.
std::string squeezed(std::string subject) {
  for (std::size_t comma = subject.find(','); comma != std::string::npos; comma = subject.find(',', comma + 1)) {
    while (comma + 1 < subject.size() && subject[comma + 1] == ' ') subject.erase(comma + 1, 1);
    while (comma > 0 && subject[comma - 1] == ' ') subject.erase(--comma, 1);
  }
  return subject;
}

std::time_t instant(const Element& validity, const char* name, const path& file) {
  const std::string text = text_of(validity, name, file);
  std::tm time{};
  if (strptime(text.c_str(), "%Y-%m-%dT%H:%M:%S", &time) == nullptr) {
    refuse(file, std::string(name) + " is '" + text + "'; expected a time such as 2026-01-31T12:00:00");
  }
  return timegm(&time);
}

void check_permissions(const path& file, const std::string& text, X509& certificate, const path& certificate_file) {
  tinyxml2::XMLDocument document;
  parse(document, file, text);
  const Element* dds = document.FirstChildElement("dds");
  if (dds == nullptr) refuse(file, "has no <dds>");
  const std::string subject = subject_of(certificate);
  std::string others;
  const Element* grant = &child(child(*dds, "permissions", file), "grant", file);
  for (; grant != nullptr; grant = grant->NextSiblingElement("grant")) {
    const std::string name = text_of(*grant, "subject_name", file);
    if (squeezed(name) != squeezed(subject)) {
      others += (others.empty() ? "'" : ", '") + name + "'";
      continue;
    }
    const Element& validity = child(*grant, "validity", file);
    const std::time_t now = std::time(nullptr);
    if (now < instant(validity, "not_before", file)) {
      refuse(file,
             "is not valid before " + text_of(validity, "not_before", file) + " UTC; is this host's clock right?");
    }
    if (now > instant(validity, "not_after", file)) {
      refuse(file, "has expired at " + text_of(validity, "not_after", file) + " UTC; make new keys");
    }
    return;
  }
  refuse(file,
         "permits nothing to '" + subject + "', the subject of " + certificate_file.string() + "; it is for " + others);
}

}  // namespace

SecurityFiles check_security_files(const path& directory, const std::string& role) {
  ERR_clear_error();
  SecurityFiles files;
  files.authority = existing(directory, "ca.cert.pem");
  if (access_of_others(directory).write) {
    refuse(std::filesystem::absolute(directory), "can be written by others than its owner (mode " +
                                                     mode_text(directory) +
                                                     "): whoever writes to the folder of keys can put an authority and "
                                                     "keys of their own in place of these; chmod 755, or 700");
  }
  if (access_of_others(files.authority).write) {
    refuse(files.authority, "can be written by others than its owner (mode " + mode_text(files.authority) +
                                "): whoever writes it decides who is trusted; chmod 644");
  }
  const Certificate authority = read_certificate(files.authority);
  const Store store(X509_STORE_new());
  X509_STORE_add_cert(store.get(), authority.get());
  files.certificate = existing(directory, role + ".cert.pem");
  const Certificate certificate = read_certificate(files.certificate);
  check_certificate(*store, files.authority, *certificate, files.certificate);
  files.key = existing(directory, role + ".key.pem");
  check_key(files.key, *certificate, files.certificate);
  files.governance = existing(directory, "governance.p7s");
  check_governance(files.governance, signed_text(files.governance, *store, files.authority));
  files.permissions = existing(directory, role + ".permissions.p7s");
  check_permissions(files.permissions, signed_text(files.permissions, *store, files.authority), *certificate,
                    files.certificate);
  ERR_clear_error();
  return files;
}

}  // namespace inslab::dds
