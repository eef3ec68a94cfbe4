#include "radiosity/output/group_matrix.h"

#include "radiosity/output/number_text.h"

#include <vector>

namespace hemicube::radiosity {
namespace {

/// Sums over the patches of one group, area-weighted.
struct GroupRow {
  std::uint32_t group = 0;
  double area = 0, space = 0, back_side = 0;
  std::vector<double> factors; ///< [numbered group]
};

class GroupMatrix {
public:
  explicit GroupMatrix(const PatchSet& patches) : patches_(patches) {}

  Status sum(const FormFactorMatrix& matrix, std::size_t group_count);
  std::string text(const Scene& scene) const;

private:
  const PatchSet& patches_;
  std::vector<std::uint32_t> number_; ///< [group of the scene] among those that have patches
  std::vector<GroupRow> rows_;
};

Status GroupMatrix::sum(const FormFactorMatrix& matrix, std::size_t group_count) {
  number_.assign(group_count, 0);
  for (const std::uint32_t group : patches_.group)
    number_[group] = 1;
  for (std::uint32_t group = 0; group < group_count; ++group)
    if (number_[group] != 0) {
      number_[group] = static_cast<std::uint32_t>(rows_.size());
      rows_.emplace_back().group = group;
    }
  for (GroupRow& row : rows_)
    row.factors.assign(rows_.size(), 0.0);
  return matrix.for_each_range([&](std::size_t first, std::size_t last) {
    for (std::uint64_t i = matrix.block_begin(first); i < matrix.block_end(last - 1); ++i) {
      const RowView row = matrix.row(i);
      GroupRow& sums = rows_[number_[patches_.group[i]]];
      const double area = patches_.area[i];
      sums.area += area;
      sums.space += area * row.space;
      sums.back_side += area * row.back_side;
      for (std::size_t k = 0; k < row.columns.size(); ++k)
        sums.factors[number_[patches_.group[row.columns[k]]]] +=
            area * (row.scale * static_cast<double>(row.values[k]));
    }
    return Status();
  });
}

std::string GroupMatrix::text(const Scene& scene) const {
  std::string text = "group,area";
  for (const GroupRow& row : rows_) {
    text += ',';
    append_csv_text(&text, scene.groups[row.group]);
  }
  text += ",space,back_side\n";
  for (const GroupRow& row : rows_) {
    append_csv_text(&text, scene.groups[row.group]);
    text += ',';
    append_number(&text, row.area);
    for (const double factor : row.factors) {
      text += ',';
      append_number(&text, factor / row.area);
    }
    for (const double loss : {row.space, row.back_side}) {
      text += ',';
      append_number(&text, loss / row.area);
    }
    text += '\n';
  }
  return text;
}

} // namespace

Status write_group_matrix(FileSet* files, std::string_view name, const FormFactorMatrix& matrix,
                          const Scene& scene, const PatchSet& patches) {
  GroupMatrix groups(patches);
  HC_TRY(groups.sum(matrix, scene.groups.size()));
  return files->add(name, groups.text(scene));
}

} // namespace hemicube::radiosity
