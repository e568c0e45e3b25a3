// SPDX-License-Identifier: BSD-3-Clause
// RadiosityLevel: the error of constant elements.
#include "radiometry/formfactor/StraddledElements.h"
#include "radiometry/solver/RadiosityLevel.h"
#include "radiometry/solver/RadiositySolver.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiometry
{
namespace
{

using Values = RadiosityLevel::Values;

constexpr double DiscretisationSafety = 2.0;
constexpr double IrregularRatio = 2.5;
constexpr int MostTerms = 6;

/// Two fields of all bands side by side, element by element, through an operator at once where its
/// exchange is the same for all bands, else one after the other.
struct ColumnPairs
{
  const FormFactorOperator& F;
  std::size_t N, Bands;

  template <class Function>
  void Each(Function&& f) const
  {
    for (std::size_t level = 0; level < 2; ++level)
    {
      f(level * this->Bands);
    }
  }
  Values Take(const Values& both, std::size_t from) const
  {
    Values one(this->N * this->Bands);
    for (std::size_t e = 0; e < this->N; ++e)
    {
      std::copy_n(
        both.data() + e * 2 * this->Bands + from, this->Bands, one.data() + e * this->Bands);
    }
    return one;
  }
  void Put(const Values& one, std::size_t from, Values& both) const
  {
    for (std::size_t e = 0; e < this->N; ++e)
    {
      std::copy_n(
        one.data() + e * this->Bands, this->Bands, both.data() + e * 2 * this->Bands + from);
    }
  }
  void Apply(const Values& in, Values& out) const
  {
    if (this->F.Bands() == 0)
    {
      this->F.Apply(in.data(), out.data(), static_cast<int>(2 * this->Bands));
      return;
    }
    this->Each([&](std::size_t from) {
      const Values one = this->Take(in, from);
      Values applied(one.size());
      this->F.Apply(one.data(), applied.data(), static_cast<int>(this->Bands));
      this->Put(applied, from, out);
    });
  }
  void ApplyError(const Values& in, Values& formFactor, Values& visibility) const
  {
    this->Each([&](std::size_t from) {
      const Values one = this->Take(in, from);
      Values form(one.size()), sight(one.size());
      this->F.ApplyError(one.data(), form.data(), sight.data(), static_cast<int>(this->Bands));
      this->Put(form, from, formFactor);
      this->Put(sight, from, visibility);
    });
  }
  void Scatter(const DiffuseScattering& scattering, const Values& in, Values& out) const
  {
    this->Each([&](std::size_t from) {
      const Values one = this->Take(in, from);
      Values scattered(one.size());
      scattering.Apply(one.data(), scattered.data(), this->Bands);
      this->Put(scattered, from, out);
    });
  }
};

} // namespace

/// What constant elements change, from what merging them changes. The differences of gathered light
/// are taken over the same pairs or rays; what remains of their sampling is taken off, since
/// VisibilityError has it already.
void RadiosityLevel::Discretise(const RadiosityContext& context,
  const DiffuseScattering& scattering, const Values& source, const StageProgress& stage)
{
  const std::size_t n = this->Elements.Size();
  const std::size_t nb = context.Bands;
  const std::size_t values = n * nb;
  const int bands = static_cast<int>(nb);
  if (context.Options.Refinement == RefinementMode::Off && this->Elements.Depth(0) > 0)
  {
    // The elements are finer than the cells: the solve without that restriction. A difference of
    // some per cent needs no more digits than that.
    const Values none;
    SolveOptions rough;
    rough.Tolerance = std::clamp(0.01 * context.Options.RelativeTolerance, 1e-8, 1e-4);
    rough.InverseBound = &none;
    rough.Threads = context.Options.Threads;
    rough.Guess = &this->Gathered;
    const SolveResult free = SolveRadiosity(*this->F, scattering, source, bands, rough, {}, stage);
    for (std::size_t k = 0; k < values; ++k)
    {
      this->Discretisation[k] = 2.0 * (free.Irradiance[k] - this->Gathered[k]);
    }
    return;
  }

  // Merged by fours and by sixteens: what the first changes, and how much less that is than what
  // the second does, tell what elements of no size would change. Both side by side.
  const std::size_t width = 2 * nb;
  std::array<std::vector<std::int32_t>, 2> group;
  std::array<Values, 2> groupArea;
  for (std::size_t level = 0; level < 2; ++level)
  {
    std::size_t count = 0;
    group[level] = this->Elements.Groups(context.Geometry, static_cast<int>(level) + 1, count);
    groupArea[level].assign(count, 0.0);
    for (std::size_t e = 0; e < n; ++e)
    {
      groupArea[level][static_cast<std::size_t>(group[level][e])] += this->Elements.GetAreas()[e];
    }
  }
  const auto merge = [&](Values& field) {
    for (std::size_t level = 0; level < 2; ++level)
    {
      Values mean(groupArea[level].size() * nb, 0.0);
      for (std::size_t e = 0; e < n; ++e)
      {
        const auto g = static_cast<std::size_t>(group[level][e]);
        const double share = this->Elements.GetAreas()[e] / groupArea[level][g];
        for (std::size_t b = 0; b < nb; ++b)
        {
          mean[g * nb + b] += share * field[e * width + level * nb + b];
        }
      }
      for (std::size_t e = 0; e < n; ++e)
      {
        const auto g = static_cast<std::size_t>(group[level][e]);
        std::copy_n(mean.data() + g * nb, nb, field.data() + e * width + level * nb);
      }
    }
  };
  Values leaves(n * width), merged(n * width);
  for (std::size_t e = 0; e < n; ++e)
  {
    std::copy_n(this->Leaving.data() + e * nb, nb, merged.data() + e * width);
    std::copy_n(this->Leaving.data() + e * nb, nb, merged.data() + e * width + nb);
  }
  merge(merged);
  for (std::size_t e = 0; e < n; ++e)
  {
    for (std::size_t b = 0; b < nb; ++b)
    {
      const std::size_t k = e * width + b;
      leaves[k] = this->Leaving[e * nb + b] - merged[k];
      leaves[k + nb] = merged[k] - merged[k + nb];
    }
  }
  const ColumnPairs twice{ *this->F, n, nb };
  Values arrived(n * width), unused(n * width), noise(n * width);
  twice.ApplyError(leaves, unused, noise);
  twice.Apply(leaves, arrived);
  Report(stage.Listener, stage.End, stage.Name);
  // Reflected on as constants of the merged elements: a few terms of the series tell.
  Values term = arrived;
  for (int k = 0; k < MostTerms; ++k)
  {
    twice.Scatter(scattering, term, leaves);
    merge(leaves);
    twice.Apply(leaves, term);
    double all = 0.0, more = 0.0;
    for (std::size_t i = 0; i < term.size(); ++i)
    {
      const double area = this->Elements.GetAreas()[i / width];
      arrived[i] += term[i];
      all += area * std::abs(arrived[i]);
      more += area * std::abs(term[i]);
    }
    if (more < 0.1 * all)
    {
      break;
    }
  }
  std::array<Values, 2> change;
  for (std::size_t level = 0; level < 2; ++level)
  {
    change[level].resize(values);
    for (std::size_t k = 0; k < values; ++k)
    {
      const std::size_t at = k / nb * width + level * nb + k % nb;
      const double square = arrived[at] * arrived[at] - noise[at] * noise[at];
      change[level][k] = square > 0.0 ? std::copysign(std::sqrt(square), arrived[at]) : 0.0;
    }
  }
  int straddled = -1; // not known
  std::size_t cells = 0;
  const std::vector<std::int32_t> cell = this->Elements.CellGroups(cells);
  for (std::size_t b = 0; b < nb; ++b)
  {
    double fine = 0.0, coarse = 0.0, area = 0.0;
    for (std::size_t e = 0; e < n; ++e)
    {
      const double a = this->Elements.GetAreas()[e];
      fine += a * std::abs(change[0][e * nb + b]);
      coarse += a * std::abs(change[1][e * nb + b]);
      area += a;
    }
    // Each division shrinks the change by `ratio`, by two (elements that something divides, a wall's
    // foot across them) to four: the changes still to come sum to 1/(ratio - 1). Where it seems to
    // shrink faster, elements happen to lie well (a foot on an edge) or the merged ones badly, and
    // neither lasts: what is left is then up to three quarters of the coarser change where elements are
    // still divided by something, and up to half as much where it only stands near them. Wherever the change is small at a place by chance, a quarter
    // of the coarser is taken, up to twice the mean of the finer.
    double irregular = 0.0;
    if (coarse > 4.0 * fine)
    {
      straddled = straddled >= 0 ? straddled
        : AnyStraddled(context.Geometry, this->Elements, context.Options.Threads) ? 1 : 0;
      irregular = (straddled ? 1.0 : 0.5) *
        std::min(0.25 * (coarse / std::max(fine, 1e-3 * coarse) - 3.0), 0.75);
    }
    const double ratio = coarse > 5.0 * fine ? IrregularRatio
      : fine > 0.0                           ? std::clamp(coarse / fine, 2.0, 4.0)
                                             : 4.0;
    const double most = 2.0 * fine / area;
    // A cell on which it shrinks less by itself counts half by that and half by all.
    std::vector<double> fineOf(cells, 0.0), coarseOf(cells, 0.0), areaOf(cells, 0.0);
    for (std::size_t e = 0; e < n; ++e)
    {
      const double a = this->Elements.GetAreas()[e];
      const auto c = static_cast<std::size_t>(cell[e]);
      fineOf[c] += a * std::abs(change[0][e * nb + b]);
      coarseOf[c] += a * std::abs(change[1][e * nb + b]);
      areaOf[c] += a;
    }
    for (std::size_t k = b; k < values; k += nb)
    {
      const auto c = static_cast<std::size_t>(cell[k / nb]);
      const double own = fine > 0.0 ? std::clamp((coarseOf[c] + areaOf[c] * coarse / area) /
                                          (fineOf[c] + areaOf[c] * fine / area),
                                        2.0, 4.0)
                                    : 4.0;
      const double quarter = std::min(0.25 * std::abs(change[1][k]), most);
      const double left = DiscretisationSafety / (std::min(ratio, own) - 1.0) *
        std::max(std::abs(change[0][k]), quarter);
      this->Discretisation[k] =
        std::copysign(std::max(left, irregular * std::abs(change[1][k])), change[0][k]);
    }
  }
}

} // namespace radiometry
