// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/sha256.h"

#include <array>
#include <stdexcept>

namespace poise {
namespace {

// libcrypto's functions return 1 on success.
void Check(int status, const char* function) {
  if (status == 1) return;
  throw std::runtime_error(std::string("SHA-256: ") + function +
                           " of libcrypto failed");
}

}  // namespace

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
  Check(context_ != nullptr, "EVP_MD_CTX_new");
  Check(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr),
        "EVP_DigestInit_ex");
}

void Sha256::Update(std::string_view bytes) {
  Check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()),
        "EVP_DigestUpdate");
}

std::string Sha256::Digest() const {
  // EVP_DigestFinal_ex() ends its stream, so it gets a copy.
  const Context copy(EVP_MD_CTX_new());
  Check(copy != nullptr, "EVP_MD_CTX_new");
  Check(EVP_MD_CTX_copy_ex(copy.get(), context_.get()), "EVP_MD_CTX_copy_ex");
  std::array<unsigned char, 32> bytes;
  Check(EVP_DigestFinal_ex(copy.get(), bytes.data(), nullptr),
        "EVP_DigestFinal_ex");
  std::string digest;
  for (const unsigned char byte : bytes) {
    digest += "0123456789abcdef"[byte >> 4];
    digest += "0123456789abcdef"[byte & 15];
  }
  return digest;
}

}  // namespace poise
