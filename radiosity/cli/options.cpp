#include "radiosity/cli/options.h"

#include "radiosity/cli/console.h"
#include "radiosity/cli/mesh_options.h"
#include "radiosity/cli/option_values.h"
#include "radiosity/cli/picture_options.h"
#include "radiosity/cli/refinement_options.h"
#include "radiosity/cli/requirements.h"
#include "raster/types.h"

// The only file that includes CLI11: it costs seconds to compile.
#include <CLI/CLI.hpp>

#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>

namespace hemicube::radiosity::cli {
namespace {

constexpr const char* kCommonGroup = "Options of all commands";
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kMaxThreads = 1024;

/// Adds an option with one value. What `set` throws as BadValue is completed with option and value.
CLI::Option* add_value(CLI::App* app, const std::string& names, const std::string& placeholder,
                       const std::string& description,
                       const std::function<void(const std::string&)>& set) {
  const std::string shown = names.substr(names.find(',') + 1);
  const auto convert = [set, shown](const std::string& text) {
    try {
      set(text);
    } catch (const BadValue& bad) {
      throw BadValue(concat(shown, " ", text, ": ", bad.what()));
    }
  };
  return app->add_option_function<std::string>(names, convert, description)->type_name(placeholder);
}

CLI::Option* add_path(CLI::App* app, const std::string& names, const std::string& placeholder,
                      const std::string& description, std::string* path) {
  return add_value(app, names, placeholder, description, [path](const std::string& text) {
    if (text.empty())
      throw BadValue("is empty");
    *path = text;
  });
}

void add_scene(CLI::App* app, CommandLine* line) {
  add_path(app, "SCENE", "", "the scene: .json, .gltf, .glb, .obj, .ply, .off or .stl",
           &line->input)
      ->required();
}

/// What the program accepts, each option bound to its member of the command line.
class Parser {
public:
  explicit Parser(CommandLine* line) : line_(*line) {
    app_.fallthrough();
    app_.require_subcommand(1);
    app_.set_version_flag("--version", concat("hemicube ", kVersion));
    formatter_->column_width(34);
    formatter_->label("SUBCOMMAND", "COMMAND");
    app_.formatter(formatter_);
    add_common();
    add_solve();
    add_formfactors();
    add_render();
    add_info();
    add_look();
    add_probe();
    add_verify();
    // Last, because commands inherit it.
    app_.footer("`hemicube COMMAND --help` tells more of a command.\n"
                "Exit status: 0 done, 1 failed or not converged, 2 usage, 3 bad scene, "
                "130 interrupted.");
  }

  CLI::App& app() { return app_; }

  /// What has to be looked at as a whole.
  void complete() {
    const char* forced = std::getenv("HEMICUBE_ISA");
    if (forced != nullptr && *forced != '\0') {
      try {
        const raster::Kernels* kernels = parse_isa(forced);
        if (line_.options.kernels == nullptr)
          line_.options.kernels = kernels;
      } catch (const BadValue& bad) {
        throw BadValue(concat("HEMICUBE_ISA=", forced, ": ", bad.what()));
      }
    }
    if (line_.options.kernels == nullptr)
      line_.options.kernels = &raster::best_kernels();
    for (const CLI::Option* option : shot_options_)
      if (option->count() != 0 && line_.options.solver != SolverKind::kProgressive)
        throw BadValue(concat(option->get_name(), ": needs --solver progressive"));
    if (line_.options.snapshot_every != 0 && line_.output.empty())
      throw BadValue("--snapshot-every: needs -o DIR, where the pictures go");
    // Some rows, to look at or to time: nothing is chosen by other rows unless asked for.
    const bool shows_rows = rows_are_given_ || line_.command == Command::kLook;
    if (shows_rows && !error_is_given_)
      line_.options.choose_rung = line_.options.choose_resolution = false;
  }

private:
  CLI::App* add_command(Command command, const char* name, const std::string& description) {
    CLI::App* sub = app_.add_subcommand(name, description);
    sub->group("Commands");
    sub->parse_complete_callback([this, command] { line_.command = command; });
    sub->footer([this] {
      const auto is_common = [](const CLI::Option* o) { return o->get_group() == kCommonGroup; };
      const CLI::App& app = app_;
      std::string text = formatter_->make_group(kCommonGroup, false, app.get_options(is_common));
      text.erase(0, text.find_first_not_of('\n'));
      return text;
    });
    return sub;
  }

  void add_common() {
    Options& options = line_.options;
    options.choose_rung = options.choose_resolution = options.estimate_error = true;
    std::vector<CLI::Option*> common;
    common.push_back(add_value(&app_, "--resolution", "N",
                               "pixels along the hemicube's edge: even, 16..2048 [chosen]",
                               [&](const std::string& text) {
                                 options.resolution = parse_resolution(text);
                                 options.choose_resolution = false;
                               }));
    common.push_back(
        add_value(&app_, "--rung", "NAME",
                  "how exact form factors are: hemicube, analytic, area, adaptive, exact [chosen]",
                  [&](const std::string& text) {
                    options.rung = parse_rung(text);
                    options.choose_rung = false;
                  }));
    common.push_back(add_value(&app_, "--error", "X",
                               "wanted error: rung and resolution are chosen to meet it [0.01]",
                               [&](const std::string& text) {
                                 options.error = parse_real_number(text, 0, 1);
                                 error_is_given_ = true;
                               }));
    common.push_back(add_value(
        &app_, "--tolerance", "X", "relative error of the radiosity the solver may leave [1e-6]",
        [&](const std::string& text) { options.tolerance = parse_real_number(text, 0, 1); }));
    common.push_back(add_value(
        &app_, "--solver", "NAME",
        "gauss-seidel, jacobi, or progressive: shoots light, without a matrix unless balanced "
        "[gauss-seidel]",
        [&](const std::string& text) { options.solver = parse_solver(text); }));
    common.push_back(
        app_.add_flag("--balance", options.balance,
                      "make the form factors reciprocal (solve, render, formfactors)"));
    add_table(&app_, mesh_options(), &line_.mesh, &common);
    common.push_back(add_value(&app_, "--threads", "N", "worker threads [one per core]",
                               [&](const std::string& text) {
                                 line_.threads = parse_whole_number(text, 1, kMaxThreads);
                               }));
    common.push_back(add_value(
        &app_, "--memory", "SIZE",
        "most memory to use, say 4GiB: what does not fit is kept in files [most of the machine's]",
        [&](const std::string& text) { line_.memory_bytes = parse_memory_size(text); }));
    common.push_back(add_value(
        &app_, "--isa", "NAME", concat("instruction set: ", raster::kernel_names(), " [the best]"),
        [&](const std::string& text) { options.kernels = parse_isa(text); }));
    common.push_back(app_.add_flag("--hash-items", options.hash_items,
                                   "report a hash of all item buffers (slow)"));
    common.push_back(
        app_.add_flag("--json", line_.json, "print the report as one JSON object on stdout"));
    common.push_back(
        app_.add_flag("--quiet", line_.quiet, "no progress, no warnings and no summary"));
    for (CLI::Option* option : common)
      option->group(kCommonGroup);
  }

  void add_solve() {
    CLI::App* sub = add_command(Command::kSolve, "solve",
                                "Compute the light in a scene: patches.csv, elements.csv "
                                "(adaptive), groups.csv, solution.ply, "
                                "solution_float.ply, solution.glb, "
                                "view.exr, view.png, report.json");
    add_scene(sub, &line_);
    add_path(sub, "-o", "DIR", "folder for the files [none: print a summary only]", &line_.output);
    sub->add_flag_callback(
        "--no-black-irradiance", [this] { line_.options.black_irradiance = false; },
        "do not gather the irradiance of patches that reflect nothing");
    add_table(sub, refinement_options(), &line_.refinement);
    add_form_factors(sub);
    add_shots(sub);
    add_exposure(sub);
    add_require(sub, true);
  }

  CLI::Option* add_form_factors(CLI::App* sub) {
    return add_path(sub, "--form-factors", "FILE.hcf",
                    "use the form factors of this file, or compute them and keep them there",
                    &line_.form_factors);
  }

  void add_shots(CLI::App* sub) {
    Options& options = line_.options;
    shot_options_ = {
        add_value(
            sub, "--stop-unshot", "X",
            "progressive: stop when so much of what is emitted is unshot [0.001; balanced: at "
            "the tolerance]",
            [&](const std::string& text) { options.stop_unshot = parse_real_number(text, 0, 1); }),
        add_value(sub, "--max-shots", "N", "progressive: stop after so many shots [no limit]",
                  [&](const std::string& text) { options.max_shots = parse_count(text, 0); }),
        add_value(sub, "--snapshot-every", "N",
                  "progressive: a picture DIR/snapshots/SHOTS.png every N shots [none]",
                  [&](const std::string& text) { options.snapshot_every = parse_count(text, 1); })};
  }

  void add_require(CLI::App* sub, bool solves) {
    add_value(
        sub, "--require", "LIST",
        concat("fail unless the result is such, separated by commas: ", known_conditions(solves)),
        [this, solves](const std::string& text) {
          line_.requirements = parse_requirements(text, solves);
        });
  }

  void add_formfactors() {
    CLI::App* sub = add_command(Command::kFormFactors, "formfactors",
                                "Compute form factors: FILE.mtx (Matrix Market) and "
                                "FILE.rows.csv, or FILE.hcf to solve with");
    add_scene(sub, &line_);
    add_path(sub, "-o", "FILE",
             "file to write: .mtx, .hcf, or .csv with --by-group [none: print a summary only]",
             &line_.output);
    add_form_factors(sub);
    CLI::Option* by_group = sub->add_flag("--by-group", line_.by_group,
                                          "form factors of groups instead of patches, into a .csv");
    CLI::Option* rows = add_value(sub, "--rows", "SELECTION",
                                  "rows of these patches only: every:N or I,J,K (from 0) [all]",
                                  [this](const std::string& text) {
                                    line_.rows = parse_rows(text);
                                    rows_are_given_ = true;
                                  });
    CLI::Option* points = add_path(
        sub, "--points", "FILE.csv",
        "rows of points instead of patches; columns x,y,z,nx,ny,nz, metres", &line_.points);
    points->excludes(rows);
    by_group->excludes(rows)->excludes(points);
    add_require(sub, false);
  }

  void add_probe() {
    CLI::App* sub =
        add_command(Command::kProbe, "probe", "Compute the irradiance at points, from a solution");
    add_path(sub, "DIR", "", "a folder written by solve", &line_.input)->required();
    add_path(sub, "--points", "FILE.csv", "columns x,y,z,nx,ny,nz, metres", &line_.points)
        ->required();
    add_path(sub, "-o", "FILE.csv", "file to write [none: the table on stdout]", &line_.output);
    add_path(sub, "--scene", "SCENE",
             "the scene DIR is the solution of [what its report.json names]", &line_.scene);
  }

  void add_render() {
    CLI::App* sub =
        add_command(Command::kRender, "render",
                    "Draw a picture of a solution; the extension of IMAGE chooses the format");
    add_path(sub, "DIR|SCENE", "", "a folder written by solve, or a scene to solve first",
             &line_.input)
        ->required();
    add_path(sub, "--scene", "SCENE",
             "the scene DIR is the solution of [what its report.json names]", &line_.scene);
    add_path(sub, "-o", "IMAGE", "picture: .png, .exr, ...", &line_.output)->required();
    add_exposure(sub);
    add_camera(sub);
    add_table(sub, picture_options(), &line_.picture);
    add_table(sub, refinement_options(), &line_.refinement);
  }

  /// @param added  may be null
  template <typename Target>
  void add_table(CLI::App* app, std::span<const TableOption<Target>> options, Target* target,
                 std::vector<CLI::Option*>* added = nullptr) {
    for (const TableOption<Target>& option : options) {
      CLI::Option* one =
          option.placeholder == nullptr
              ? app->add_flag_callback(
                    option.names, [target, option] { option.set({}, target); }, option.description)
              : add_value(app, option.names, option.placeholder, option.description,
                          [target, option](const std::string& text) { option.set(text, target); });
      if (added != nullptr)
        added->push_back(one);
    }
  }

  void add_camera(CLI::App* sub) {
    CameraOptions& camera = line_.camera;
    add_value(sub, "--size", "WxH", "pixels [the scene's, or 600x600]",
              [&camera](const std::string& text) { parse_size(text, &camera); });
    const auto add_place = [sub](const char* name, const char* description,
                                 std::optional<Vec3>* value) {
      add_value(sub, name, "X,Y,Z", description,
                [value](const std::string& text) { *value = parse_vector(text); });
    };
    add_place("--camera-position", "metres [the scene's camera, or outside, fitted]",
              &camera.position);
    add_place("--camera-target", "a point in the middle of the picture, metres", &camera.target);
    add_place("--camera-up", "a direction that is up in the picture", &camera.up);
    add_value(sub, "--fov", "DEGREES", "vertical field of view",
              [&camera](const std::string& text) {
                camera.field_of_view = parse_real_number(text, 0, 180);
              });
  }

  void add_exposure(CLI::App* sub) {
    add_value(
        sub, "--exposure", "X",
        "display white is a radiance of 1/X W/(m^2 sr), or 1/X of what is shown [chosen from the "
        "picture]",
        [this](const std::string& text) {
          line_.exposure = parse_real_number(text, 0, kInfinity);
        });
  }

  void add_info() {
    add_scene(add_command(Command::kInfo, "info",
                          "Tell what would be modelled and why, and what it would cost"),
              &line_);
  }

  void add_look() {
    CLI::App* sub = add_command(Command::kLook, "look",
                                "Show what one patch sees: its unfolded hemicube and its row");
    add_scene(sub, &line_);
    const auto add_number = [sub](const char* name, const char* description,
                                  std::optional<std::uint32_t>* value) {
      return add_value(sub, name, "I", description, [value](const std::string& text) {
        *value = parse_whole_number(text, 0, raster::kMaxPolygonCount - 1);
      });
    };
    CLI::Option* patch = add_number("--patch", "number of the patch, from 0", &line_.patch);
    CLI::Option* face = add_number(
        "--face", "number of the face in the file, from 0: its first patch", &line_.face);
    face->excludes(patch);
    add_path(sub, "-o", "PNG", "picture: item colours, depth, weights [none: the row only]",
             &line_.output);
    sub->add_flag("--all", line_.whole_row, "print the whole row, not the 20 largest form factors");
    sub->final_callback([this] {
      if (!line_.patch && !line_.face)
        throw BadValue("look needs --patch I or --face I");
    });
  }

  void add_verify() {
    add_command(Command::kVerify, "verify",
                "Compute what is known exactly, on every rung or on that of --rung: a table of "
                "errors and times")
        ->add_flag("--all", line_.all_cases, "also what is hard: thin, tiny, far, coincident");
  }

  CommandLine& line_;
  std::vector<const CLI::Option*> shot_options_;
  bool error_is_given_ = false, rows_are_given_ = false;
  std::shared_ptr<CLI::Formatter> formatter_ = std::make_shared<CLI::Formatter>();
  CLI::App app_{"Deterministic diffuse radiosity and form factors by hemicubes, on the CPU.",
                "hemicube"};
};

std::string usage_hint(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return concat("; see `hemicube ", commands.empty() ? "" : commands.front()->get_name() + " ",
                "--help`");
}

/// CLI11's message, or a better one where it would not name the word that is wrong.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  if (app.get_subcommands().empty()) {
    std::string commands;
    for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
      commands += concat(commands.empty() ? "" : ", ", sub->get_name());
    for (const std::string& word : app.remaining())
      if (!word.starts_with('-'))
        return concat("unknown command '", word, "'; there are ", commands);
    if (app.remaining().empty())
      return concat("a command is missing; there are ", commands);
    return concat("unknown option ", app.remaining().front());
  }
  std::string message = error.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    return message.substr(0, message.find(':')) + ": takes exactly one value";
  return message;
}

} // namespace

ParseOutcome parse_command_line(int argc, char** argv, CommandLine* line) {
  Parser parser(line);
  CLI::App& app = parser.app();
  try {
    app.parse(argc, argv);
    parser.complete();
    return ParseOutcome::kRun;
  } catch (const CLI::CallForHelp&) {
    print(app.help());
    return ParseOutcome::kDone;
  } catch (const CLI::CallForVersion& version) {
    print(concat(version.what(), "\n"));
    return ParseOutcome::kDone;
  } catch (const CLI::ParseError& error) {
    print_message(usage_message(app, error) + usage_hint(app));
  } catch (const BadValue& bad) {
    print_message(bad.what() + usage_hint(app));
  }
  return ParseOutcome::kUsageError;
}

} // namespace hemicube::radiosity::cli
