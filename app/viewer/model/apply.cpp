#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/recent_files.h"
#include "app/viewer/model/viewer_model.h"
#include "engine/core/error.h"
#include "engine/forming/material_library.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/outputs.h"

namespace spia::viewer {

/// One call per kind of action. What throws is told to the user by apply().
struct ViewerModel::Apply {
    ViewerModel& model;
    ViewerState& state = model.state_;
    Document& document = state.document;
    Session& session = document.session;

    /// Before every change that undo brings back.
    void change(std::string name, bool merge = false)
    {
        state.history.remember(std::move(name), document, merge);
        state.unsaved = true;
    }
    const PartFile& part() const
    {
        if (!session.part)
            throw InputError("Open a part first.");
        return *session.part;
    }

    // --- the chain
    /// Ends what runs, whatever it is about, and begins with another document.
    void begin_with(Document fresh)
    {
        if (model.chain_job_) {
            model.chain_job_->cancel();
            model.ending_.push_back(std::move(model.chain_job_));
        }
        model.next_.reset();
        model.project_.reset();
        model.picks_.reset();
        state.job = JobView{};
        document = std::move(fresh);
        state.history = History{};
        for (Message& message : state.messages)
            message.dismissed = true;
        state.refused.reset();
        state.fault.reset();
        model.dragging_ = false;
        model.keep_cameras_ = false;
        model.opening_ = true;
        model.start(Stage::read, Stage::read, "Opening " + document.session.file.filename().string());
    }
    void require_no_export() const
    {
        if (model.export_job_)
            throw InputError("Wait for the export to end.");
    }
    void operator()(const OpenPart& action)
    {
        require_no_export();
        Document fresh;
        fresh.display = document.display;
        fresh.display.range.reset();
        fresh.material = document.material;
        fresh.session.options.flatten.material = session.options.flatten.material;
        fresh.session.options.flatten.thickness = session.options.flatten.thickness;
        fresh.session.options.interpolate = session.options.interpolate;
        if (!action.unit.empty())
            fresh.session.options.read.unit = length_unit(action.unit);
        fresh.session.file = action.file;
        if (!std::filesystem::exists(action.file))
            throw InputError(fmt::format("There is no file {}.", action.file.string()));
        state.project.clear();
        state.unsaved = false;
        begin_with(std::move(fresh));
    }
    void operator()(const SetUnit& action)
    {
        const LengthUnit unit = length_unit(action.unit);
        if (part().unit == unit)
            return;
        if (model.busy())
            throw InputError("Cancel the running job first; then change the unit.");
        change("Change unit");
        session.options.read.unit = unit;
        forget_picks();
        model.opening_ = true;
        model.run_to(Stage::read, "Reading the part again");
    }
    void operator()(const SetReading& action)
    {
        if (session.file.empty())
            throw InputError("Open a part first.");
        if (model.busy())
            throw InputError("Cancel the running job first; then read the part otherwise.");
        ReadOptions& read = session.options.read;
        if (read.weld == action.weld && read.doctor.keep_largest == action.keep_largest)
            return;
        change("Read the part otherwise");
        (*this)(DismissMessages{}); // of the part as it was read before
        if (session.part)
            model.picks_ = store_picks(document);
        read.weld = action.weld;
        read.doctor.keep_largest = action.keep_largest;
        forget_picks();
        document.regions.clear();
        model.opening_ = true;
        model.run_to(Stage::read, "Reading the part again");
    }
    /// Numbers of faces mean others when the part is read otherwise.
    void forget_picks()
    {
        document.selected.clear();
        document.vertices.clear();
        document.probes.clear();
        document.section.reset();
    }
    void operator()(const RunTo& action)
    {
        if (model.opening_) { // as soon as the part is there
            model.next_ = action.stage;
            return;
        }
        if (!first_stale(document) || *first_stale(document) > action.stage) {
            model.say(Severity::hint, "Everything is up to date.");
            return;
        }
        part();
        for (Message& message : state.messages) // of the run before
            message.dismissed |= message.severity != Severity::error;
        change(action.stage == Stage::solve ? "Unfold" : "Run the chain");
        model.run_to(action.stage, action.stage == Stage::solve ? "Unfolding" : "Running the chain");
    }
    void operator()(const CancelJob&)
    {
        model.next_.reset();
        if (model.chain_job_)
            model.chain_job_->cancel();
        if (model.export_job_)
            model.export_job_->cancel();
    }
    void operator()(const SetMaterial& action)
    {
        const Material material = find_material(action.material, model.assets() / "materials");
        change("Change material");
        document.material = action.material;
        session.options.flatten.material = material;
    }
    void operator()(const SetThickness& action)
    {
        if (!(action.thickness > 0 && action.thickness < 1000))
            throw InputError("The thickness must be above 0 and below 1000 mm.");
        change("Change thickness", true);
        session.options.flatten.thickness = action.thickness;
    }
    void operator()(const SetDirection& action)
    {
        if (action.direction && !(action.direction->norm() > 0))
            throw InputError("The stamping direction needs a length above 0.");
        change("Change stamping direction");
        session.options.flatten.direction = action.direction;
    }
    void operator()(const SetCorner& action)
    {
        if (!session.blank)
            throw InputError("Unfold the part first; then its corners can be chosen.");
        if (action.corner < 0 || action.corner > 3)
            throw InputError(fmt::format("There is no corner {}; they count from 0 to 3.", action.corner));
        if (action.vertex < 0 || action.vertex >= part().mesh.vertices())
            throw InputError(fmt::format("The part has no vertex {}.", action.vertex));
        const std::vector<int>& outline = model.pickers_.outline(session);
        if (std::find(outline.begin(), outline.end(), action.vertex) == outline.end())
            throw InputError(
                fmt::format("Vertex {} is not on the outer outline of the blank, where corners have to be.",
                            part().source_vertex[size_t(action.vertex)]));
        std::array<int, 4> corners = corners_now();
        const int in_file = part().source_vertex[size_t(action.vertex)];
        for (int k = 0; k < 4; ++k)
            if (k != action.corner && corners[size_t(k)] == in_file)
                return; // two corners at one place: the mouse is on its way past the other one
        change(fmt::format("Move corner {}", action.corner + 1), true);
        if (!action.dragging)
            state.history.close();
        corners[size_t(action.corner)] = in_file;
        session.options.corners = corners;
        model.dragging_ = action.dragging;
        model.run_to(action.dragging ? Stage::grid : Stage::fit, "Making the grid");
    }
    void operator()(const ProposeCorners&)
    {
        change("Propose corners");
        session.options.corners.reset();
        if (session.blank)
            model.run_to(Stage::fit, "Making the grid");
    }
    void operator()(const SetGrid& action)
    {
        const GridOptions& grid = action.grid;
        if (grid.columns < 0 || grid.rows < 0 || grid.columns > 2000 || grid.rows > 2000 || grid.cells < 1 ||
            grid.cells > 2000)
            throw InputError("A grid has from 1 to 2000 cells each way (0: automatic).");
        change("Change grid", true);
        session.options.grid = grid;
        if (session.blank)
            model.run_to(Stage::fit, "Making the grid");
    }
    void operator()(const SetEnds& action)
    {
        change("Change ends of the surface");
        session.options.interpolate.ends =
            action.natural ? InterpolateOptions::Ends::natural : InterpolateOptions::Ends::averaged_knots;
        if (session.lifted)
            model.run_to(Stage::fit, "Fitting the surface");
    }

    // --- picking
    void select(std::vector<int> faces, PickMode mode, const char* name)
    {
        std::sort(faces.begin(), faces.end());
        faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
        if (!faces.empty() && (faces.front() < 0 || faces.back() >= part().mesh.triangles()))
            throw InputError(fmt::format("The part has no face {}.", faces.front() < 0 ? faces.front() : faces.back()));
        FaceSet result = picked(document.selected, faces, mode);
        if (result == document.selected)
            return;
        change(name, name == std::string_view("Brush faces"));
        document.selected = std::move(result);
    }
    void operator()(const SelectFaces& action) { select(action.faces, action.mode, "Select faces"); }
    /// What a picking tool needs of the view it is used in.
    const RayPicker& picker(View view)
    {
        if (const RayPicker* found = model.pickers_.picker(session, view))
            return *found;
        throw InputError(view == View::blank ? "Unfold the part first." : "Open a part first.");
    }
    const Camera& camera(View view) const { return state.view.camera[size_t(view)]; }
    void operator()(const PickAt& action)
    {
        const RayPicker& on = picker(action.view);
        select(faces_at(action, camera(action.view), on, model.pickers_.regions(session)), action.mode,
               action.flood    ? "Flood fill"
               : action.smooth ? "Select smooth region"
                               : "Pick face");
    }
    void operator()(const PickArea& action)
    {
        const RayPicker& on = picker(action.view);
        select(faces_in(action, camera(action.view), *model.pickers_.mesh(session, action.view), on), action.mode,
               action.polygon.size() == 4 ? "Select by box" : "Select by lasso");
    }
    void operator()(const PickBrush& action)
    {
        const RayPicker& on = picker(action.view);
        select(faces_under(action, camera(action.view), *model.pickers_.mesh(session, action.view), on), action.mode,
               "Brush faces");
    }
    void operator()(const GrowSelection&)
    {
        select(grown(part().mesh, document.selected), PickMode::replace, "Grow selection");
    }
    void operator()(const ShrinkSelection&)
    {
        select(shrunk(part().mesh, document.selected), PickMode::replace, "Shrink selection");
    }
    void operator()(const InvertSelection&)
    {
        select(inverted(document.selected, part().mesh.triangles()), PickMode::replace, "Invert selection");
    }
    void operator()(const ClearSelection&)
    {
        if (document.selected.empty() && document.vertices.empty())
            return;
        change("Clear selection");
        document.selected.clear();
        document.vertices.clear();
    }
    void select_vertices(std::vector<int> vertices, PickMode mode, const char* name)
    {
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        require_vertices(vertices);
        std::vector<int> result = picked(document.vertices, vertices, mode);
        if (result == document.vertices)
            return;
        change(name);
        document.vertices = std::move(result);
    }
    /// @param vertices ascending
    void require_vertices(const std::vector<int>& vertices) const
    {
        if (!vertices.empty() && (vertices.front() < 0 || vertices.back() >= part().mesh.vertices()))
            throw InputError(
                fmt::format("The part has no vertex {}.", vertices.front() < 0 ? vertices.front() : vertices.back()));
    }
    void operator()(const SelectVertices& action) { select_vertices(action.vertices, action.mode, "Select vertices"); }
    void operator()(const PickVertex& action)
    {
        picker(action.view); // says what is missing
        const std::optional<int> vertex = model.pickers_.vertex_at(session, action, camera(action.view));
        select_vertices(vertex ? std::vector{*vertex} : std::vector<int>{}, action.mode,
                        action.boundary ? "Pick boundary vertex" : "Pick vertex");
    }
    void operator()(const UseVerticesAsCorners&)
    {
        const PartFile& file = part();
        std::array<int, 4> corners = corners_of(document.vertices, model.pickers_.outline(session), file.source_vertex);
        if (session.blank) { // begin where the automatic ones would: lowest to the left
            const Eigen::Matrix2Xd& plane = session.blank->blank.position;
            const auto height = [&](int v) { return plane.col(v).sum(); };
            std::rotate(
                corners.begin(),
                std::min_element(corners.begin(), corners.end(), [&](int a, int b) { return height(a) < height(b); }),
                corners.end());
        }
        change("Use vertices as corners");
        for (int& corner : corners)
            corner = file.source_vertex[size_t(corner)];
        session.options.corners = corners;
        if (session.blank)
            model.run_to(Stage::fit, "Making the grid");
    }

    size_t region(int number) const
    {
        if (number < 0 || size_t(number) >= document.regions.size())
            throw InputError(fmt::format("There is no region {}.", number + 1));
        return size_t(number);
    }
    void operator()(const MakeRegion& action)
    {
        constexpr size_t most = 62; // FaceMarks
        static constexpr std::array<Colour, 6> colours = {Colour{0.96f, 0.76f, 0.18f, 1}, {0.30f, 0.69f, 0.36f, 1},
                                                          {0.35f, 0.60f, 0.92f, 1},       {0.86f, 0.42f, 0.64f, 1},
                                                          {0.55f, 0.47f, 0.85f, 1},       {0.30f, 0.72f, 0.74f, 1}};
        if (document.selected.empty())
            throw InputError("Select faces first; a region is made of them.");
        if (document.regions.size() >= most)
            throw InputError(fmt::format("There are {} regions already; remove one first.", most));
        change("Make region");
        FaceRegion made;
        made.kind = action.kind;
        made.name =
            action.name.empty() ? fmt::format("{} {}", name(action.kind), document.regions.size() + 1) : action.name;
        made.colour = colours[document.regions.size() % colours.size()];
        made.faces = document.selected;
        document.regions.push_back(std::move(made));
    }
    void operator()(const ChangeRegion& action)
    {
        const size_t number = region(action.region);
        change("Change region", true);
        FaceRegion& changed = document.regions[number];
        changed.name = action.name;
        changed.kind = action.kind;
        if (action.colour[3] > 0)
            changed.colour = action.colour;
    }
    void operator()(const RemoveRegion& action)
    {
        const size_t number = region(action.region);
        change("Remove region");
        document.regions.erase(document.regions.begin() + int(number));
    }
    void operator()(const SelectRegion& action)
    {
        select(document.regions[region(action.region)].faces, action.mode, "Select region");
    }
    void operator()(const AddProbe& action)
    {
        if (action.probe.face < 0 || action.probe.face >= part().mesh.triangles())
            throw InputError(fmt::format("The part has no face {}.", action.probe.face));
        change("Pin probe");
        document.probes.push_back(action.probe);
    }
    void operator()(const RemoveProbe& action)
    {
        if (action.probe < 0 || size_t(action.probe) >= document.probes.size())
            throw InputError(fmt::format("There is no probe {}.", action.probe + 1));
        change("Remove probe");
        document.probes.erase(document.probes.begin() + action.probe);
    }
    void operator()(const ClearProbes&)
    {
        change("Remove all probes");
        document.probes.clear();
    }

    void operator()(const DrawSection& action)
    {
        const RayPicker& on = picker(action.view);
        const Camera& from = camera(action.view);
        const RayHit first = hit_at(from, on, action.from, action.size),
                     last = hit_at(from, on, action.to, action.size);
        if (first.face < 0 && last.face < 0)
            throw InputError("Draw the section line over the sheet: at least one end has to be on it.");
        const Ray a = ray_through(from, on.box(), action.from, action.size),
                  b = ray_through(from, on.box(), action.to, action.size);
        // Both ends at the same depth, that of the end which is on the sheet.
        const Eigen::Vector3d hit = first.face >= 0 ? Eigen::Vector3d(a.origin + first.distance * a.direction)
                                                    : Eigen::Vector3d(b.origin + last.distance * b.direction);
        const Eigen::Vector3d sight = ray_through(from, on.box(), action.size / 2., action.size).direction;
        const auto at_depth = [&](const Ray& ray) -> Eigen::Vector3d {
            return ray.origin + sight.dot(hit - ray.origin) / sight.dot(ray.direction) * ray.direction;
        };
        SectionLine line{at_depth(a), at_depth(b), sight, action.view == View::blank};
        if (!((line.to - line.from).norm() > 0))
            throw InputError("Drag the mouse to draw a section line.");
        change("Draw section");
        document.section = line;
    }
    void operator()(const ClearSection&)
    {
        change("Remove section");
        document.section.reset();
    }

    // --- looking
    void operator()(const SetDisplay& action)
    {
        change("Change display", true);
        document.display = action.display;
    }
    void operator()(const SetViewSettings& action) { state.view = action.view; }
    void operator()(const FitView& action) { model.fit(action.view); }
    void operator()(const LookFrom& action)
    {
        for (const View view : all_views)
            if (view == action.view || (state.view.linked && view != View::blank && action.view != View::blank))
                state.view.camera[size_t(view)] = look(state.view.camera[size_t(view)], action.from);
    }
    void operator()(const FlyTo& action)
    {
        const TriMesh& mesh = part().mesh;
        if (action.face < 0 || action.face >= mesh.triangles())
            throw InputError(fmt::format("The part has no face {}.", action.face));
        const auto t = mesh.triangle.col(action.face);
        look_at({t[0], t[1], t[2]});
        select({action.face}, PickMode::replace, "Go to face");
    }
    void operator()(const FlyToVertex& action)
    {
        require_vertices({action.vertex});
        look_at({action.vertex});
    }
    /// Every view shows the middle of some vertices of the part.
    void look_at(const std::vector<int>& vertices)
    {
        const TriMesh& mesh = part().mesh;
        const auto middle = [&](const auto& position) {
            Eigen::Vector3d sum = Eigen::Vector3d::Zero();
            for (const int v : vertices)
                sum.head(position.rows()) += position.col(v) / double(vertices.size());
            return glm::dvec3(sum[0], sum[1], sum[2]);
        };
        const double size = 0.15 * (mesh.position.rowwise().maxCoeff() - mesh.position.rowwise().minCoeff()).norm();
        for (const View view : all_views) {
            if (view == View::blank && !session.blank)
                continue;
            Camera& camera = state.view.camera[size_t(view)];
            camera.target = view == View::blank ? middle(session.blank->blank.position) : middle(mesh.position);
            camera.height = std::min(camera.height, size);
        }
    }
    void operator()(const ShowFault& action)
    {
        const PartFile* examined = session.part ? session.part.get() : state.refused.get();
        if (!examined)
            throw InputError("Open a part first.");
        const auto& findings = examined->doctor.findings;
        if (action.finding < 0 || size_t(action.finding) >= findings.size())
            throw InputError(fmt::format("The mesh doctor has no finding {}.", action.finding));
        const auto& place = findings[size_t(action.finding)].place;
        if (action.entry < 0 || size_t(action.entry) >= place.size())
            throw InputError(fmt::format("This finding has no place {}.", action.entry));
        const Eigen::Vector3d& at = place[size_t(action.entry)];
        state.fault = ShownFault{action.finding, action.entry, at};
        const double size = 0.15 * bounding_diagonal(examined->mesh);
        for (const View view : all_views) {
            Camera& camera = state.view.camera[size_t(view)];
            if (view == View::part || (state.view.linked && view != View::blank)) {
                camera.target = glm::dvec3(at[0], at[1], at[2]);
                if (size > 0)
                    camera.height = std::min(camera.height, size);
            }
        }
    }

    // --- the document and files
    void operator()(const Undo&) { go(&History::undo); }
    void operator()(const Redo&) { go(&History::redo); }
    void go(void (History::*way)(Document&))
    {
        if (model.chain_job_)
            throw InputError("Cancel the running job first; then undo.");
        (state.history.*way)(document);
        state.unsaved = true;
    }
    void operator()(const OpenProject& action)
    {
        require_no_export();
        Project project = open_project(action.file, model.assets() / "materials");
        const bool left_behind = is_autosave(action.file); // of a part without a project `recovers` is empty
        state.project = left_behind ? project.recovers : action.file;
        state.unsaved = left_behind;
        begin_with(project.document);
        model.project_ = std::move(project);
    }
    void operator()(const SaveProject& action)
    {
        const std::filesystem::path file = action.file.empty() ? state.project : action.file;
        if (file.empty())
            throw InputError("Give the project a name: Save project as.");
        save_project(file, document, state.view);
        state.project = file;
        state.unsaved = false;
        model.say(Severity::done, fmt::format("Saved {}", file.string()));
    }
    void operator()(const ExportFiles& action)
    {
        if (model.chain_job_ || model.export_job_)
            throw InputError("Wait for the running job to end, then export.");
        if (!session.blank)
            throw InputError("There is nothing to export yet: run the chain first.");
        state.job = JobView{};
        state.job.running = true;
        state.job.title = "Exporting";
        model.export_job_ = std::make_unique<Job<std::vector<std::filesystem::path>>>(
            [session = session, action](const Progress& progress) {
                return write_outputs(session, action.folder, action.formats, action.options, progress);
            },
            model.wake_);
    }
    void operator()(const DismissMessages&)
    {
        for (Message& message : state.messages)
            message.dismissed = true;
    }
    void operator()(const Screenshot&) {}
    void operator()(const WriteReport&) {}
    void operator()(const Quit&) {}

    std::array<int, 4> corners_now() const
    {
        if (session.options.corners)
            return *session.options.corners;
        if (!session.grid)
            throw InputError("Make the grid first; then its corners can be moved.");
        std::array<int, 4> corners{};
        for (size_t k = 0; k < 4; ++k)
            corners[k] = part().source_vertex[size_t(session.grid->boundary.corner[k])];
        return corners;
    }
};

void ViewerModel::apply(const Action& action)
{
    try {
        std::visit(Apply{*this}, action);
    } catch (const std::exception& error) {
        say(Severity::error, error.what());
    }
}

} // namespace spia::viewer
