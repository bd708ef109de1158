#pragma once
#include <cstdint>
#include <random>

namespace spia::shapes {

/// Random numbers that are the same on every platform, unlike those of the standard library's
/// distributions.
class SeededRandom {
public:
    explicit SeededRandom(std::uint64_t seed) : random_(seed) {}
    double between(double low, double high) { return low + (high - low) * double(random_() >> 11) * 0x1p-53; }
    int whole(int low, int high) { return low + int(random_() % std::uint64_t(high - low + 1)); }
    bool coin() { return random_() & 1; }

private:
    std::mt19937_64 random_;
};

} // namespace spia::shapes
