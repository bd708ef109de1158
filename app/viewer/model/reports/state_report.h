#pragma once
#include "app/viewer/model/document/state.h"
#include "engine/core/json_file.h"

namespace spia::viewer {

/// The state of the program as tests and --report see it (schema "spia-state/1"; expectations of
/// scripts point into it):
///
/// |---|---|
/// - `part`: null, or `file`, `vertices`, `triangles`, `format`, `unit`
/// - `options`: `material`, `thickness`, `skins`, `seam`, `direction` (null: automatic), `corners`
///   (vertices of the file; null: automatic), `grid`, `fit` (as in the script action set_fit)
/// - `stages.{read,solve,grid,lift,fit}`: whether the result of the stage is there
/// - `figures`: what the chain found: the JSON of `spia run --json` without `files`, see
///   engine/pipeline/README.md
/// - `selection`: `faces`: how many; `first`: the first ten of them
/// - `vertices[]`: picked: `vertex` (of the part), `in_file`, `boundary`, `at` and `blank` (mm;
///   null: none yet), `value` of the field shown, smooth (null: none)
/// - `distance`: of two picked vertices: null, or straight `part`, `blank` (mm; null: none yet)
/// - `regions[]`: `name`, `kind`, `colour`, `faces`, `first`
/// - `probes[]`: `face`, `barycentric`, `at` (mm), `value` of the field shown, in its unit (null:
///   none)
/// - `measurements[]`: `kind`, `at`, `on` (as in add_measurement), `value` (mm, of angles degrees),
///   `text`, `residual` (mm, of a rounding; else null), `on_blank` (mm, of a distance once there is
///   a blank)
/// - `display`: as in the script action set_display
/// - `grades`: that can be chosen: `built_in[]`, `own[]`, `at_fault` (why, by the stem of the file)
/// - `comparison`: null, or `reference` (its name), `by_face` (whether there are differences),
///   `outline_distance` (mm), `figures` (`reference`, `now` of each)
/// - `field`: null, or of the field shown: `unit`, `least`, `greatest`
/// - `view`: as in the script action set_view
/// - `corners`: of the grid: null, or four `vertex` (of the part), `at` (mm, on the part), `blank`
///   (mm)
/// - `history`: `undo`, `redo`: names of the changes; "" where there is none
/// - `messages[]`: `severity` (hint, done, warning, error), `text`; the newest last
/// - `job`: `running`, `cancelling`, `title`, `step`, `fraction`, `steps` (residuals so far)
/// - `spot`: the face that `fly_to` has marked; null: none
/// - `project`: `file` ("" if none), `unsaved`, `waits` (a file that is read while the user is
///   asked about unsaved work; "" if none)
/// - `hovered`: face under the mouse, or null
/// - `hovered_vertex`: which a click would pick, or null
/// - `frames`, `frames_while_solving`: of the window only: how many, and `p50_ms`, `p99_ms`,
///   `max_ms` it was busy with one
/// - `window`: of the window only, pixels: `size`, `views.{part,...}.{at,size}` of the pictures
///   shown, `mouse` (null: outside), `buttons` held
///
/// Faces and vertices are numbers of the part in the program, from 0. Members are only added within
/// a version.
Json state_report(const ViewerState& state);

} // namespace spia::viewer
