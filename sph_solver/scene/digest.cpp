#include "scene/digest.hpp"

#include "scene/case.hpp"

#include <array>
#include <fstream>
#include <openssl/evp.h>
#include <sstream>

namespace cupel
{

std::string sha256(std::string_view bytes)
{
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int length = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
        throw std::runtime_error("sha256: the system's OpenSSL refuses it; check its configuration");
    static constexpr const char* digits = "0123456789abcdef";
    std::string text;
    for (unsigned int index = 0; index < length; ++index) {
        text += digits[digest[index] >> 4];
        text += digits[digest[index] & 15];
    }
    return text;
}

std::string sha256_of_file(const std::string& path)
{
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream content;
    if (!stream || !(content << stream.rdbuf()))
        throw CaseError(path + ": cannot be read or is empty; check that it exists and that you may read it");
    return sha256(content.str());
}

} // namespace cupel
