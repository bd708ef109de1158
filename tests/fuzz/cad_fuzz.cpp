#include "tests/fuzz/cad_fuzz.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <execinfo.h>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <new>
#include <pthread.h>
#include <sanitizer/asan_interface.h>
#include <set>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <unistd.h>
#include <vector>

#include "tests/fuzz/cad_copy.h"
#include "tests/fuzz/cad_search.h"
#include "tests/fuzz/crash_owner.h"

/// The counters of this program's branches, which libFuzzer looks at; the linker names their begin
/// and end.
extern "C" __attribute__((visibility("hidden"))) std::uint8_t __start___sancov_cntrs[], __stop___sancov_cntrs[];

namespace spia::fuzz {
namespace {

namespace fs = std::filesystem;

/// Counts in the copies are counts here.
class SharedCoverage {
public:
    SharedCoverage()
    {
        if (size_ > 0 &&
            ::mmap(begin_, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == MAP_FAILED)
            throw std::bad_alloc();
    }
    void forget() { std::memset(begin_, 0, size_); }

private:
    // The first and the last page hold other data, too, and are left out.
    static char* page_of(std::uint8_t* counter, size_t into)
    {
        const auto page = std::uintptr_t(::sysconf(_SC_PAGESIZE));
        return reinterpret_cast<char*>((std::uintptr_t(counter) + into) / page * page);
    }
    char* begin_ = page_of(__start___sancov_cntrs, size_t(::sysconf(_SC_PAGESIZE)) - 1);
    size_t size_ = size_t(std::max(page_of(__stop___sancov_cntrs, 0) - begin_, std::ptrdiff_t(0)));
};

// Not for the compiler to see.
volatile bool yes = true;
volatile size_t large = 3;
volatile double huge = 1e30;
int* volatile nowhere = nullptr;

int deeper(int n) { return yes ? 1 + deeper(n + 1) : n; }

/// @throws std::logic_error, a number
bool does_wrong(std::string_view what)
{
    if (what == "a null pointer")
        *nowhere = 1;
    if (what == "a place behind the end")
        return std::vector<int>(3)[large] == 0;
    if (what == "a conversion without meaning")
        return int(huge) > 0;
    if (what == "a recursion without end")
        return deeper(0) > 0;
    if (what == "a loop without end")
        while (yes)
            large = large + 1;
    if (what == "too much memory")
        return std::vector<char>(large << 40).back() == 0;
    if (what == "an exception")
        throw std::logic_error("on purpose");
    if (what == "an exception of another kind")
        throw 1;
    std::abort();
}

/// @returns a fault of ours that copies do not tell; empty: none
std::string unseen_fault(const fs::path& file)
{
    for (const char* what :
         {"a null pointer", "a place behind the end", "a conversion without meaning", "a recursion without end",
          "a loop without end", "too much memory", "an exception", "an exception of another kind", "an abort"})
        if (CadCopy([what](const fs::path&) { return does_wrong(what); }, file).read() != fault)
            return std::string(what) + " is not told";
    return "";
}

pid_t this_process = 0;

class Search {
public:
    explicit Search(const CadTarget& target)
        : file_(fs::temp_directory_path() / fmt::format("spia-fuzz-{}.{}", ::getpid(), target.name)),
          folder_(std::getenv("SPIA_FUZZ_ENDED") ? std::getenv("SPIA_FUZZ_ENDED") : ""), copy_(read_and_examine, file_)
    {
        ::signal(SIGPIPE, SIG_IGN); // a copy may be gone before it is asked
        std::array<void*, 1> loads_the_unwinder;
        ::backtrace(loads_the_unwinder.data(), 1);
        this_process = ::getpid();
        __sanitizer_set_death_callback(
            [] { // of this process for libFuzzer to keep the file, not of those that read for users
                if (::getpid() == this_process)
                    std::abort();
            });
        ::pthread_atfork(nullptr, nullptr, [] { // libFuzzer's handlers would take a crash there for
                                                // one of this program
            for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
                ::signal(signal, SIG_DFL);
        });
        std::string wrong(fault_of_owners());
        if (wrong.empty())
            wrong = unseen_fault(file_);
        for (const std::string& seed : target.seeds) { // what OpenCASCADE makes once, the copies
                                                       // have
            put(seed);
            if (!read_and_examine(file_) || CadCopy(read_and_examine, file_).read() != accepted)
                wrong = "a seed is not accepted: " + seed;
        }
        if (!wrong.empty()) {
            std::fprintf(stderr, "the search proves nothing: %s\n", wrong.c_str());
            std::exit(2);
        }
    }
    Search(const Search&) = delete;
    Search& operator=(const Search&) = delete;
    ~Search()
    {
        print();
        remove_file();
    }

    void read(std::string_view content)
    {
        ++files_;
        put(content);
        const double before = copy_.seconds();
        Outcome outcome = copy_.read();
        const bool slow = !copy_.is_new() && copy_.seconds() - before > 0.04; // computing
        if (outcome == fault)
            outcome = of_a_new_copy();
        ++of_[size_t(outcome - refused)];
        const bool ended = outcome != accepted && outcome != refused;
        if (ended) {
            keep(copy_.place());
            constexpr int each = 10; // to read all of them again would take most of the time;
                                     // spia-fuzz-cad does
            if (++ended_ % each == 1)
                read_as_users_do();
        }
        if (ended || slow) // else most of the next ones would be made from such files, and the
                           // search would crawl
            coverage_.forget();
        constexpr long often = 100'000;
        if (files_ % often == 0)
            print();
    }

private:
    void put(std::string_view content) { std::ofstream(file_, std::ios::binary) << content; }

    void remove_file()
    {
        std::error_code gone;
        fs::remove(file_, gone);
    }

    [[noreturn]] void give_up()
    {
        print();
        remove_file();
        std::abort(); // libFuzzer keeps the file
    }

    /// What OpenCASCADE had done before may be the reason.
    Outcome of_a_new_copy()
    {
        const bool was_new = copy_.is_new();
        copy_.end();
        const Outcome again = was_new ? fault : CadCopy(read_and_examine, file_).read();
        if (again == fault)
            give_up();
        save(fmt::format("disturbed-{}-{}", ::getpid(), ++disturbed_));
        return again;
    }

    void read_as_users_do()
    {
        std::string wrong;
        try {
            ++again_;
            cancelled_ += !is_answered(file_);
        } catch (const std::exception& fault) {
            wrong = fault.what();
        }
        if (wrong.empty())
            return;
        std::fprintf(stderr, "read as users do: %s\n", wrong.c_str());
        give_up();
    }

    void keep(const std::string& place)
    {
        constexpr size_t most = 500;
        if (places_.size() < most && places_.insert(place).second)
            save(place);
    }

    void save(const std::string& name)
    {
        std::error_code failed;
        if (!folder_.empty())
            fs::copy_file(file_, folder_ / (name + file_.extension().string()), failed);
    }

    void print() const
    {
        const auto count = [&](Outcome outcome) { return of_[size_t(outcome - refused)]; };
        std::fprintf(
            stderr,
            "files: %ld, accepted %ld, refused %ld; OpenCASCADE crashed on %ld, needed too much memory for %ld "
            "and did not end on %ld, at %zu places; %ld of these were read again as users do, %ld answered and "
            "%ld cancelled; %ld faults that a new copy did not repeat\n",
            files_, count(accepted), count(refused), count(crashed), count(too_much), count(endless), places_.size(),
            again_, again_ - cancelled_, cancelled_, disturbed_);
    }

    fs::path file_, folder_;
    SharedCoverage coverage_;
    CadCopy copy_;
    long files_ = 0, ended_ = 0, again_ = 0, cancelled_ = 0, disturbed_ = 0;
    std::array<long, fault - refused> of_{}; ///< by Outcome
    std::set<std::string> places_;
};

} // namespace

void fuzz_cad(const CadTarget& target, std::string_view content)
{
    static Search search(target);
    search.read(content);
}

} // namespace spia::fuzz
