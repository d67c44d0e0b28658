#include "kernels/pair_loop.hpp"

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

std::vector<std::byte, CacheLineAllocator<std::byte>> memory;

} // namespace

std::size_t pass_memory_bytes()
{
    return memory.size();
}

void release_pass_memory()
{
    memory = {};
}

std::byte* pass_memory(std::size_t bytes)
{
    if (memory.size() < bytes) memory = std::vector<std::byte, CacheLineAllocator<std::byte>>(bytes);
    return memory.data();
}

} // namespace cupel::inline CUPEL_ENGINE
