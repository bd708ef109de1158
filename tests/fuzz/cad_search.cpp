#include "tests/fuzz/cad_search.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <memory>
#include <new>
#include <random>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/time.h>
#include <unistd.h>

#include "engine/core/error.h"
#include "engine/exchange/cad/child_process.h"
#include "engine/exchange/cad/read_cad.h"
#include "tests/fuzz/cad_target.h"
#include "tests/fuzz/mutate.h"

namespace spia::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int in_one_process = 1000;
constexpr int enough = 2; // seconds for one file of a few kilobytes

/// How far a child is; outlives it.
class SharedCounts {
public:
    struct Counts {
        int at, accepted;
    };
    SharedCounts() : counts_(::mmap(nullptr, sizeof(Counts), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))
    {
        if (counts_ == MAP_FAILED)
            throw std::bad_alloc();
    }
    SharedCounts(const SharedCounts&) = delete;
    SharedCounts& operator=(const SharedCounts&) = delete;
    ~SharedCounts() { ::munmap(counts_, sizeof(Counts)); }
    Counts* operator->() const { return static_cast<Counts*>(counts_); }

private:
    void* counts_;
};

/// Gone with this.
struct ScratchFile {
    fs::path path;
    explicit ScratchFile(fs::path at) : path(std::move(at)) {}
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ~ScratchFile()
    {
        std::error_code gone;
        fs::remove(path, gone);
    }
};

} // namespace

bool is_answered(const fs::path& file)
{
    const auto stop = std::make_shared<std::atomic<bool>>(false);
    const auto start = Clock::now();
    const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    const Progress time_limit([&](double, std::string_view) { *stop = seconds() > enough; }, stop);
    try {
        read_cad(file, {}, {}, {}, time_limit);
    } catch (const InputError&) {
    } catch (const Cancelled&) {
        if (seconds() > 2 * enough)
            throw std::logic_error("it could not be cancelled");
        return false;
    }
    return true;
}

std::string damaged_cad_file(std::string_view format, int number)
{
    const CadTarget& target = cad_target(format);
    std::mt19937 random(unsigned(number) + 1u);
    return damaged(target.seeds[size_t(number) % target.seeds.size()], target.spice, random);
}

CadSearch search_cad(std::string_view format, int first, int files)
{
    const ScratchFile scratch(fs::temp_directory_path() / fmt::format("spia-search-{}.{}", ::getpid(), format));
    const fs::path& file = scratch.path;
    const auto put = [&](int number) { std::ofstream(file, std::ios::binary) << damaged_cad_file(format, number); };
    const SharedCounts shared;
    cad_target(format); // made here, not in every child
    CadSearch search;
    for (int next = first; next < first + files;) {
        const int end = std::min(first + files, next + in_one_process);
        shared->at = next;
        shared->accepted = 0;
        const auto read_them = [&](const Progress&, const ChildLog&) -> std::string {
            for (int number = next; number < end; ++number) {
                put(number);
                const itimerval most{{}, {enough, 0}};    // of computing
                ::setitimer(ITIMER_PROF, &most, nullptr); // ends this process
                try {
                    shared->accepted += read_and_examine(file);
                    shared->at = number + 1;
                } catch (const std::bad_alloc&) {
                    throw;
                } catch (const std::exception& fault) {
                    return fmt::format("file {}: {}", number, fault.what());
                }
            }
            return "";
        };
        bool ended = false;
        try {
            const std::string fault = in_child(read_them, [](std::string_view) {}, {});
            if (!fault.empty())
                throw std::logic_error(fault);
        } catch (const InputError&) {
            ended = true;
        }
        search.accepted += shared->accepted;
        search.refused += shared->at - next - shared->accepted;
        search.files += shared->at - next;
        next = shared->at;
        if (ended) {
            put(next);
            try {
                ++(is_answered(file) ? search.crashed : search.endless);
            } catch (const std::logic_error& fault) {
                throw std::logic_error(fmt::format("file {}: {}", next, fault.what()));
            }
            ++search.files;
            ++next;
        }
    }
    return search;
}

} // namespace spia::fuzz
