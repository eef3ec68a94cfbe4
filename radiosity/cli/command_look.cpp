#include "radiosity/cli/commands.h"
#include "radiosity/cli/console.h"
#include "radiosity/cli/session.h"
#include "radiosity/hemicube/five_views.h"
#include "radiosity/output/hemicube_losses.h"
#include "radiosity/output/image_writer.h"
#include "radiosity/output/look_picture.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace hemicube::radiosity::cli {
namespace {

constexpr std::size_t kLargestShown = 20, kBacksShown = 10;

struct Entry {
  std::uint32_t patch;
  double form_factor;
};

/// The row, largest form factor first, of equal ones the lower patch first.
std::vector<Entry> sorted_row(const RowView& row) {
  std::vector<Entry> entries;
  for (std::size_t k = 0; k < row.columns.size(); ++k)
    entries.push_back({row.columns[k], row.scale * static_cast<double>(row.values[k])});
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.form_factor != b.form_factor ? a.form_factor > b.form_factor : a.patch < b.patch;
  });
  return entries;
}

/// The patch that --patch or --face means.
Status choose_patch(const Session& session, std::uint32_t* patch) {
  const CommandLine& line = session.line;
  const PatchSet& patches = session.loaded.patches;
  const std::uint32_t count = patches.patch_count();
  if (line.patch) {
    *patch = *line.patch;
    if (*patch < count)
      return {};
    return Status::error(StatusCode::kInvalidArgument, "--patch ", *patch,
                         " does not exist: there are ", count, " patches, counted from 0");
  }
  const std::uint32_t face = *line.face;
  if (face >= session.loaded.scene.face_count())
    return Status::error(StatusCode::kInvalidArgument, "--face ", face,
                         " does not exist: there are ", session.loaded.scene.face_count(),
                         " faces, counted from 0");
  const auto first = std::find(patches.face.begin(), patches.face.end(), face);
  if (first == patches.face.end())
    return Status::error(StatusCode::kInvalidArgument, "--face ", face,
                         " has no patch: it was dropped");
  *patch = static_cast<std::uint32_t>(first - patches.face.begin());
  const auto pieces = std::count(patches.face.begin(), patches.face.end(), face);
  if (pieces > 1 && !line.quiet)
    print_message(
        concat("face ", face, " has ", pieces, " patches; this is the first, patch ", *patch));
  return {};
}

/// Renders the hemicube, says where light is lost, and draws the picture where one is wanted.
Status draw(const Session& session, std::uint32_t patch, HemicubeLosses* losses) {
  const Options& options = session.line.options;
  const PatchSet& patches = session.loaded.patches;
  const std::string& output = session.line.output;
  FileSet files;
  std::string name;
  if (!output.empty()) {
    HC_TRY(files.begin_file(output, &name));
    HC_TRY(load_image_plugin());
  }
  HemicubeImage hemicube;
  HC_TRY(render_hemicube(patches, patch, options.resolution, *options.kernels, &hemicube));
  DeltaFormFactors weights;
  HC_TRY(weights.init(options.resolution));
  HC_TRY(find_losses(hemicube, weights, hemicube_view(patches, patch), losses));
  if (output.empty())
    return {};
  ColorImage image;
  HC_TRY(draw_look(hemicube, weights, &image));
  HC_TRY(write_display_image(&files, name, image));
  return files.commit();
}

/// What there is to print.
struct Look {
  const LoadedScene& loaded;
  std::uint32_t patch;
  RowView row;
  std::vector<Entry> entries; ///< all, or the largest
  std::uint64_t item_hash;
  const HemicubeLosses& losses;
  std::span<const HemicubeLosses::Back> backs; ///< all, or the first

  std::string_view material(std::uint32_t of_patch) const {
    return loaded.scene.materials[loaded.patches.material[of_patch]];
  }
};

void print_json(const Look& look) {
  using Json = nlohmann::ordered_json;
  const auto patch_json = [&look](std::uint32_t patch) {
    Json json;
    json["patch"] = patch;
    json["face"] = look.loaded.patches.face[patch];
    json["material"] = std::string(look.material(patch));
    return json;
  };
  Json json = patch_json(look.patch);
  json["row_sum"] = row_sum(look.row);
  json["space"] = look.row.space;
  json["back_side"] = look.row.back_side;
  const Vec3& towards = look.losses.space_towards;
  if (look.losses.space > 0)
    json["space_towards"] = {towards.x, towards.y, towards.z};
  for (const HemicubeLosses::Back& back : look.backs) {
    json["backs"].push_back(patch_json(back.patch));
    json["backs"].back()["fraction"] = back.fraction;
  }
  json["nonzeros"] = look.row.columns.size();
  json["hashes"]["items"] = hex(look.item_hash);
  Json& row = json["row"] = Json::array();
  for (const Entry& entry : look.entries) {
    row.push_back(patch_json(entry.patch));
    row.back()["form_factor"] = entry.form_factor;
  }
  print(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void print_csv(const Look& look) {
  const auto place = [&look](std::uint32_t patch) {
    std::string text = concat(patch, ",", look.loaded.patches.face[patch], ",");
    append_csv_text(&text, look.material(patch));
    return text;
  };
  print("# patch,face,material " + place(look.patch) + "\n");
  print(concat("# row_sum ", row_sum(look.row), "\n# space ", look.row.space, "\n# back_side ",
               look.row.back_side, "\n# items ", hex(look.item_hash), "\n"));
  const Vec3& towards = look.losses.space_towards;
  if (look.losses.space > 0)
    print(concat("# space towards ", towards.x, ",", towards.y, ",", towards.z, "\n"));
  for (const HemicubeLosses::Back& back : look.backs)
    print(concat("# back of patch,face,material ", place(back.patch), ": ", back.fraction, "\n"));
  print("patch,face,material,form_factor\n");
  for (const Entry& entry : look.entries)
    print(concat(place(entry.patch), ",", entry.form_factor, "\n"));
  if (look.entries.size() < look.row.columns.size())
    print(concat("# ", look.row.columns.size() - look.entries.size(), " smaller ones: --all\n"));
}

} // namespace

Status run_look(const CommandLine& line) {
  if (!line.output.empty()) {
    const Result<ImageKind> kind = image_kind(line.output);
    HC_TRY(kind.status());
    if (kind.value() != ImageKind::kDisplay)
      return Status::error(StatusCode::kInvalidArgument, "-o ", line.output,
                           ": this picture holds display colours; use .png");
  }
  CommandLine with_hash = line;
  with_hash.options.hash_items = true;
  Session session(with_hash);
  HC_TRY(session.begin(line.input));
  std::uint32_t patch = 0;
  HC_TRY(choose_patch(session, &patch));
  FormFactorMatrix matrix;
  Certificate certificate;
  HC_TRY(session.form_factors({&patch, 1}, &matrix, &certificate));
  HemicubeLosses losses;
  HC_TRY(draw(session, patch, &losses));

  const std::size_t shown = line.whole_row ? losses.backs.size() : kBacksShown;
  Look look{session.loaded,
            patch,
            matrix.row(0),
            sorted_row(matrix.row(0)),
            certificate.item_hash,
            losses,
            losses.backs.span().first(std::min(shown, losses.backs.size()))};
  if (!line.whole_row && look.entries.size() > kLargestShown)
    look.entries.resize(kLargestShown);
  line.json ? print_json(look) : print_csv(look);
  return {};
}

} // namespace hemicube::radiosity::cli
