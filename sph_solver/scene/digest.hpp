/// SHA-256 of bytes, by the system's OpenSSL.
#pragma once

#include <string>
#include <string_view>

namespace cupel
{

/// 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

/// The same of a file's content. Throws CaseError when it cannot be read.
std::string sha256_of_file(const std::string& path);

} // namespace cupel
