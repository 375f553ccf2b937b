// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <openssl/evp.h>

#include <memory>
#include <string>
#include <string_view>

namespace poise {

/// SHA-256 of a stream of bytes, computed by OpenSSL's libcrypto. Every member
/// throws std::runtime_error if libcrypto reports an error.
/// Source: FIPS 180-4, section 6.2.
class Sha256 {
 public:
  Sha256();

  void Update(std::string_view bytes);

  /// Returns the digest of all bytes so far, as 64 hexadecimal digits. Update()
  /// may be called again afterwards.
  std::string Digest() const;

 private:
  struct Free {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };
  using Context = std::unique_ptr<EVP_MD_CTX, Free>;

  Context context_;
};

}  // namespace poise
