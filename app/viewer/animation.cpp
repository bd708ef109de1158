#include "app/viewer/animation.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/render/gif_file.h"
#include "app/viewer/render/picture_file.h"
#include "app/viewer/views/colour_scale.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/small_dense.h"
#include "engine/mesh/topology.h"
#include "engine/report/figures/face_values.h"
#include "engine/report/text/lengths.h"

namespace fs = std::filesystem;

namespace spia::viewer {
namespace {

/// Flat points in space, turned and moved as near as can be to others of the same number, by least
/// squares.
Eigen::Matrix3Xd laid_beside(const Eigen::Matrix2Xd& flat, const Eigen::Matrix3Xd& part)
{
    Eigen::Matrix3Xd from = Eigen::Matrix3Xd::Zero(3, flat.cols());
    from.topRows<2>() = flat;
    const Eigen::Vector3d centre = from.rowwise().mean(), there = part.rowwise().mean();
    from.colwise() -= centre;
    const Eigen::Matrix3d covariance = (part.colwise() - there) * from.transpose();
    return (nearest_rotation(covariance) * from).colwise() + there;
}

/// Slowly away and slowly there, within each step.
double eased(double position)
{
    const double whole = std::floor(position), share = position - whole;
    return whole + share * share * (3 - 2 * share);
}

/// So that colours mean the same from the first picture to the last: the range of all states.
void fix_range(ViewerState& state)
{
    Document& document = state.document;
    FieldDisplay& display = document.display;
    if (display.range || !state.view.field_on_steps || !available_in_steps(display.field))
        return;
    std::array<double, 2> all{1e300, -1e300};
    for (const UnfoldState& each : document.unfolding->run.states) {
        const auto extremes = face_values(document.session.part->mesh, each.face, display.field).extremes();
        all = {std::min(all[0], extremes[0]), std::max(all[1], extremes[1])};
    }
    const ColourScale scale = field_scale(display, all, bounding_diagonal(document.session.part->mesh),
                                          as_shown(info(display.field).unit, state.preferences.lengths).factor);
    display.range = std::array<double, 2>{double(scale.least), double(scale.greatest)};
}

/// Places that the camera must show: of the part, of all states and halfway between them.
Eigen::Matrix3Xd all_places(const Document& document, double end)
{
    constexpr Eigen::Index most = 400'000;
    const int states = 2 * int(end) + 1;
    const Eigen::Index stride = 1 + document.session.part->mesh.position.cols() * states / most;
    std::vector<Eigen::Vector3d> places;
    for (int k = 0; k < states; ++k) {
        const Eigen::Matrix3Xd here = unfolded_places(document, k / 2.);
        for (Eigen::Index v = 0; v < here.cols(); v += stride)
            places.push_back(here.col(v));
    }
    Eigen::Matrix3Xd result(3, Eigen::Index(places.size()));
    for (size_t k = 0; k < places.size(); ++k)
        result.col(Eigen::Index(k)) = places[k];
    return result;
}

/// On one colour: a gradient would take the few colours that there are.
void lay_on_ground(Picture& picture, bool dark)
{
    const std::array<int, 3> ground = dark ? std::array{29, 33, 39} : std::array{255, 255, 255};
    for (size_t k = 0; k < picture.rgba.size(); k += 4) {
        const int a = picture.rgba[k + 3];
        for (size_t c = 0; c < 3; ++c)
            picture.rgba[k + c] = uint8_t((picture.rgba[k + c] * a + ground[c] * (255 - a) + 127) / 255);
        picture.rgba[k + 3] = 255;
    }
}

} // namespace

Document blank_as_state(const Document& document)
{
    if (!document.session.part || !document.session.blank)
        throw InputError("There is nothing to animate yet: unfold the part first.");
    const Session& session = document.session;
    Document result = document;
    auto step = std::make_shared<PlannedStep>();
    step->name = "Unfold";
    step->kind = UnfoldKind::flatten;
    UnfoldState flat;
    flat.name = step->name;
    flat.position = laid_beside(session.blank->blank.position, session.part->mesh.position);
    flat.face = session.blank->face;
    flat.step = Eigen::VectorXi::Ones(session.part->mesh.triangles());
    auto run = std::make_shared<StepsRun>();
    run->part = session.part;
    run->steps = result.steps = {step};
    run->sheet = sheet_of_steps(session.options.flatten);
    run->run.states.push_back(std::move(flat));
    run->figure.resize(1);
    result.unfolding = std::move(run);
    result.proposal = nullptr;
    return result;
}

/// What becomes of the pictures; all but the constructor runs on the thread.
class Animation::Files {
public:
    virtual ~Files() = default;
    virtual void begin(const std::vector<Picture>& samples) = 0;
    virtual void add(const Picture& picture) = 0;
    virtual std::vector<fs::path> end() = 0;
    std::vector<fs::path> written; ///< by end()
};

class Animation::Gif : public Animation::Files {
public:
    explicit Gif(const SaveAnimation& wanted) : wanted_(wanted) {}
    void begin(const std::vector<Picture>& samples) override { colours_ = std::make_unique<GifColours>(samples); }
    void add(const Picture& picture) override { rasters_.push_back(colours_->raster(picture)); }
    std::vector<fs::path> end() override
    {
        GifWriter file(wanted_.width, wanted_.height, *colours_);
        std::vector<size_t> order;
        for (size_t k = 0; k < rasters_.size(); ++k)
            order.push_back(k);
        for (size_t k = rasters_.size() - 1; wanted_.back && k-- > 1;) // both ends are shown once
            order.push_back(k);
        const double seconds = wanted_.seconds * double(order.size()) / double(rasters_.size());
        const std::vector<int> delays = gif_delays(int(order.size()), seconds);
        for (size_t k = 0; k < order.size(); ++k) {
            const bool end = order[k] == 0 || order[k] + 1 == rasters_.size();
            constexpr int hold = 60; // hundredths: time to look at part and blank
            file.add(rasters_[order[k]], delays[k] + (end ? hold : 0));
        }
        write_atomically(wanted_.file, file.end());
        return {wanted_.file};
    }

private:
    SaveAnimation wanted_;
    std::unique_ptr<GifColours> colours_;
    std::vector<std::vector<uint8_t>> rasters_;
};

/// Numbered pictures. They are made in a folder of their own, and take their places when all are
/// there.
class Animation::Series : public Animation::Files {
public:
    explicit Series(const SaveAnimation& wanted) : file_(fs::absolute(wanted.file))
    {
        folder_ = file_.parent_path() / fmt::format(".{}-parts", file_.stem().string());
    }
    ~Series() override
    {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    void begin(const std::vector<Picture>&) override
    {
        std::error_code error;
        fs::remove_all(folder_, error);
        fs::create_directories(folder_, error);
        if (error)
            throw ExchangeError(fmt::format("cannot make the folder {}: {}; check who may write there",
                                            folder_.string(), error.message()));
    }
    void add(const Picture& picture) override
    {
        names_.push_back(fmt::format("{}-{:03}.png", file_.stem().string(), names_.size() + 1));
        write_png(folder_ / names_.back(), picture);
    }
    std::vector<fs::path> end() override
    {
        std::vector<fs::path> files;
        for (const std::string& name : names_) {
            files.push_back(file_.parent_path() / name);
            std::error_code error;
            fs::rename(folder_ / name, files.back(), error);
            if (error)
                throw ExchangeError(fmt::format("cannot write {}: {}", files.back().string(), error.message()));
        }
        return files;
    }

private:
    fs::path file_, folder_;
    std::vector<std::string> names_;
};

Animation::Animation(const SaveAnimation& wanted, const ViewerState& state, std::function<void()> wake)
    : wanted_(wanted), shown_(state), worker_(std::move(wake))
{
    if (!state.document.session.part)
        throw InputError("Open a part first.");
    steps_ = steps_done(state.document) > 0;
    if (!steps_) {
        shown_.document = blank_as_state(state.document);
        shown_.view.field_on_steps = true;
    }
    if (wanted.frames < 2 || wanted.width < 1 || wanted.height < 1 || !(wanted.seconds > 0))
        throw InputError("An animation needs at least two pictures, a size and a duration.");
    constexpr double most = 5e8; // pixels: half a gigabyte of memory
    if (double(wanted.frames) * wanted.width * wanted.height > most)
        throw InputError("The animation would be too large: take fewer pictures, or smaller ones.");
    require_writable(wanted.file);
    end_ = double(steps_done(shown_.document));
    Document& document = shown_.document;
    document.selected.clear();
    document.vertices.clear();
    document.display.extremes = false;
    document.display.difference = false;
    shown_.hovered.reset();
    shown_.hovered_vertex.reset();
    shown_.fault.reset();
    shown_.view.step.reset();
    shown_.view.maximised.reset();
    fix_range(shown_);
    Camera& camera = shown_.view.camera[size_t(View::part)];
    const bool field = shown_.view.field_on_steps;
    constexpr double beside = 0.06; // of the width: the target of a step reaches beyond what lies
                                    // on it
    const double scale = picture_scale(wanted.width, wanted.height),
                 around = 24 * scale + (field ? 0 : beside * wanted.width),
                 legend = wanted.legend && field ? 100 * scale : 0;
    camera = fit(camera, all_places(document, end_), {wanted.width, wanted.height},
                 {around + legend, around, around, around});
    if (wanted.file.extension() == ".png")
        files_ = std::make_shared<Series>(wanted);
    else
        files_ = std::make_shared<Gif>(wanted);
}

Animation::~Animation() { cancel(); }

Picture Animation::picture(Renderer& renderer, ViewerModel& model, double share, int width, int height)
{
    constexpr double begun = 1e-6; // of the way: the part itself, but with the field that its
                                   // forming has given it
    shown_.view.unfolded = std::max(begun, eased(end_ * share));
    if (steps_ && !shown_.view.field_on_steps)
        shown_.view.step = int(std::ceil(shown_.view.unfolded)) - 1;
    Picture result = picture_of_view(renderer, model, shown_, cache_, View::part, width, height,
                                     {.legend = wanted_.legend, .labels = false, .ground = false});
    lay_on_ground(result, shown_.view.dark);
    return result;
}

void Animation::draw_next(Renderer& renderer, ViewerModel& model)
{
    constexpr size_t enough = 3; // pictures that wait
    while (!pending_.empty() && pending_.front().ready()) {
        try {
            pending_.front().get();
        } catch (...) {
            error_ = error_ ? error_ : std::current_exception();
            cancel();
        }
        pending_.pop_front();
    }
    if (*cancelled_ || all_asked_ || pending_.size() >= enough)
        return;
    if (drawn_ == 0) {
        std::vector<Picture> samples;
        for (const double share : {0., 0.3, 0.5, 0.7, 1.})
            samples.push_back(
                picture(renderer, model, share, std::max(1, wanted_.width / 2), std::max(1, wanted_.height / 2)));
        pending_.push_back(worker_.later([files = files_, samples = std::move(samples)] {
            files->begin(samples);
            return true;
        }));
    }
    pending_.push_back(worker_.later(
        [files = files_, cancelled = cancelled_,
         drawn = picture(renderer, model, double(drawn_) / (wanted_.frames - 1), wanted_.width, wanted_.height)] {
            if (!*cancelled)
                files->add(drawn);
            return true;
        }));
    if (++drawn_ < wanted_.frames)
        return;
    all_asked_ = true;
    pending_.push_back(worker_.later([files = files_, cancelled = cancelled_] {
        if (!*cancelled)
            files->written = files->end();
        return true;
    }));
}

bool Animation::ended() const { return pending_.empty() && (*cancelled_ || all_asked_); }

double Animation::fraction() const
{
    const double whole = wanted_.frames + 2;
    return std::clamp((drawn_ - double(pending_.size()) + (all_asked_ ? 2 : 0)) / whole, 0., 1.);
}

std::vector<fs::path> Animation::take()
{
    if (error_)
        std::rethrow_exception(error_);
    return files_->written;
}

} // namespace spia::viewer
