#include "output/code_identity.hpp"

#include "cupel_version.hpp"

namespace cupel
{

CodeIdentity code_identity()
{
    return {code_version, code_commit};
}

} // namespace cupel
