// Writes the seeds of a format as files, and its spice as a dictionary of libFuzzer:
// spia-fuzz-seeds FORMAT FOLDER
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>

#include "tests/fuzz/cad_target.h"
#include "tests/fuzz/fuzz_target.h"

int main(int count, char** values)
{
    if (count != 3) {
        std::fputs("usage: spia-fuzz-seeds FORMAT FOLDER\n", stderr);
        return 2;
    }
    const bool cad = spia::fuzz::is_cad_target(values[1]);
    const auto& seeds = cad ? spia::fuzz::cad_target(values[1]).seeds : spia::fuzz::fuzz_target(values[1]).seeds;
    const auto& words = cad ? spia::fuzz::cad_target(values[1]).spice : spia::fuzz::fuzz_target(values[1]).spice;
    const std::filesystem::path folder = values[2];
    std::filesystem::create_directories(folder / "corpus");
    for (size_t k = 0; k < seeds.size(); ++k)
        std::ofstream(folder / "corpus" / fmt::format("seed-{}", k), std::ios::binary) << seeds[k];
    std::ofstream dictionary(folder / "words.dict");
    for (const std::string& word : words) {
        dictionary << '"';
        for (const char c : word.substr(0, 60)) // longer ones are not taken
            dictionary << fmt::format("\\x{:02X}", (unsigned char)c);
        dictionary << "\"\n";
    }
}
