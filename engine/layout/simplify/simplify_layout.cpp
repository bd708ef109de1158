#include "engine/layout/simplify/simplify_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "engine/layout/simplify/operations.h"
#include "engine/layout/simplify/relax.h"

namespace spia {

namespace {

/// Random numbers that are the same on every platform.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : random_(seed) {}
    double share() { return (double(random_() >> 11) + 0.5) * 0x1p-53; } ///< above 0, below 1
    size_t below(size_t n) { return size_t(random_() % n); }

private:
    std::mt19937_64 random_;
};

/// A change that may be tried: at side or corner k of a face.
struct Candidate {
    enum class Kind { diagonal, strip, turn, turn_back } kind;
    int face, k;
};

class Simplifier {
public:
    Simplifier(LayoutMesh mesh, const SimplifyOptions& options, const Progress& progress)
        : mesh_(std::move(mesh)), options_(options), progress_(progress), draw_(options.seed)
    {
        // Cells of grids looked at for each face of the start: 1 to 3 s for 500 faces. With four
        // times as much the layouts of five parts had an eighth fewer patches, with a quarter of it
        // a quarter more.
        constexpr double per_face = 80'000, more_faces = 50; // a small one is searched as a larger one
        most_work_ = options.effort * per_face * (mesh_.alive() + more_faces);
    }

    LayoutMesh run()
    {
        heal();
        shrink_strips();
        best_ = mesh_;
        for (int round = 0; share() < 1; ++round)
            search(round);
        finish();
        return std::move(*best_);
    }

private:
    double share() const { return std::min(1.0, double(mesh_.work()) / most_work_); }

    /// The start may be folded beside small fillets.
    void heal()
    {
        constexpr int most_sweeps = 6;
        for (int sweep = 0; sweep < most_sweeps && mesh_.least_quality() < options_.least_quality; ++sweep)
            relax_all(mesh_, 1, options_.least_quality);
    }

    /// Tries a change: kept if the energy grows by less than `most` and no face gets worse than it
    /// may be.
    template <class Change> bool attempt(const Change& change, double most)
    {
        mesh_.begin();
        if (!change() || !mesh_.sound()) {
            mesh_.undo();
            return false;
        }
        mesh_.judge_edited();
        std::vector<int> around;
        for (const int f : std::vector<int>(mesh_.edited_faces()))
            if (!mesh_.face(f).gone)
                around.insert(around.end(), mesh_.face(f).vertex.begin(), mesh_.face(f).vertex.end());
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        constexpr int sweeps = 3;
        constexpr double hope = 2; // that a sweep may still gain, at most
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            relax(mesh_, around, 1, options_.least_quality);
            if (mesh_.energy_change() > most + hope)
                break;
        }
        if (mesh_.energy_change() > most ||
            mesh_.least_after() < std::min(options_.least_quality, mesh_.least_before()) ||
            mesh_.worse_than(options_.least_quality) > mesh_.worse_before(options_.least_quality) ||
            crossed_by_now() > mesh_.crossed_before()) {
            mesh_.undo();
            return false;
        }
        mesh_.keep();
        return true;
    }

    /// How many of the faces that were edited have sides that cross.
    int crossed_by_now()
    {
        int count = 0;
        for (size_t i = 0; i < mesh_.edited_faces().size(); ++i)
            if (const int f = mesh_.edited_faces()[i]; !mesh_.face(f).gone)
                count += mesh_.look_for_crossing(f);
        return count;
    }

    void shrink_strips()
    {
        constexpr double longest = 0.3; // of the search
        for (bool changed = true; changed && share() < longest;) {
            changed = false;
            for (const QuadStrip& strip : strips_of(mesh_)) {
                progress_.checkpoint(share(), "simplifying the layout");
                changed = attempt([&] { return collapse_strip(mesh_, strip); }, 0);
                if (changed || share() > longest)
                    break;
            }
        }
    }

    std::vector<Candidate> candidates()
    {
        using enum Candidate::Kind;
        std::vector<Candidate> result;
        for (int f = 0; f < mesh_.faces(); ++f) {
            if (mesh_.face(f).gone)
                continue;
            for (const int k : {0, 1})
                for (const auto kind : {diagonal, strip})
                    result.push_back({kind, f, k});
            for (const int k : {0, 1, 2, 3}) {
                const int a = mesh_.face(f).vertex[size_t(k)], b = mesh_.face(f).vertex[size_t(k + 1) % 4];
                if (a < b && mesh_.face_from(b, a) >= 0 && !mesh_.on_arc(a, b))
                    for (const auto kind : {turn, turn_back})
                        result.push_back({kind, f, k});
            }
        }
        for (size_t i = result.size(); i > 1; --i)
            std::swap(result[i - 1], result[draw_.below(i)]);
        return result;
    }

    bool apply(const Candidate& candidate)
    {
        switch (candidate.kind) {
        case Candidate::Kind::diagonal: return collapse_diagonal(mesh_, candidate.face, candidate.k);
        case Candidate::Kind::strip: return collapse_strip(mesh_, strip_of(mesh_, candidate.face, candidate.k));
        case Candidate::Kind::turn: return rotate_side(mesh_, candidate.face, candidate.k, true);
        default: return rotate_side(mesh_, candidate.face, candidate.k, false);
        }
    }

    /// All candidates once, in random order.
    void search(int round)
    {
        constexpr double hottest = 0.35;
        const long before = mesh_.work();
        for (const Candidate& candidate : candidates()) {
            if (mesh_.face(candidate.face).gone)
                continue;
            progress_.checkpoint(share(), "simplifying the layout");
            const double temperature = hottest * (1 - share()) * (1 - share());
            attempt([&] { return apply(candidate); }, -temperature * std::log(draw_.share()) - 1e-9);
        }
        if (round % 3 == 2)
            relax_all(mesh_, 1, options_.least_quality);
        if (mesh_.energy() < best_->energy())
            best_ = mesh_;
        if (mesh_.work() == before) // nothing is left that can be tried
            most_work_ = double(before);
    }

    /// Every patch as good as it can be.
    void finish()
    {
        constexpr int most_sweeps = 30;
        constexpr double good = 0.8;
        FacePrice price = best_->price();
        price.good = good;
        best_->judge_all(price);
        double energy = best_->energy();
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            relax_all(*best_, 1, options_.least_quality);
            const double now = best_->energy();
            if (now > energy - 1e-3)
                break;
            energy = now;
        }
    }

    LayoutMesh mesh_;
    const SimplifyOptions& options_;
    const Progress& progress_;
    Draw draw_;
    double most_work_ = 0;
    std::optional<LayoutMesh> best_;
};

} // namespace

Layout simplify_layout(const Layout& start, const SimplifyOptions& options, const Progress& progress)
{
    if (!LayoutMesh::represents(start))
        return start;
    LayoutMesh mesh(start, {options.corner_deg * std::numbers::pi / 180, options.corner_radius});
    if (options.refine)
        mesh.refine();
    return Simplifier(std::move(mesh), options, progress).run().layout(start);
}

} // namespace spia
