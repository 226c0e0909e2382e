// SPDX-License-Identifier: MIT

#include "integrators/caustic_guide.h"

#include "base/float_mode.h"
#include "base/parallel.h"
#include "integrators/caustic_photons.h"

#include <algorithm>
#include <chrono>

namespace plumb {
namespace {

// A kernel reaches as far as this many other photons of its cell say that it must, and then as far again: light that no
// kernel reaches costs more than wide kernels do.
constexpr std::size_t neighbours = 3;
constexpr float reach = 2.f;
constexpr float narrowest = 0.005f; // sine of half a cone's angle
constexpr float widest = 0.8f;
constexpr std::size_t fewest_photons = 8; // of a cell that guides
// By how much the second moment of what guided and unguided directions find together must be below that of the unguided alone.
constexpr double least_gain = 2.0;

Vec3f source_of(const CausticPhoton& photon, float distance)
{
    return photon.position + photon.towards * distance;
}

// Squared sine of the angle by which `source` misses the direction from which a photon came; 1 for opposite directions.
float miss(const Vec3f& source, const CausticPhoton& photon)
{
    const Vec3f towards = source - photon.position;
    const float size2 = length_squared(towards);
    if (!(size2 > 0.f) || !(dot(towards, photon.towards) > 0.f)) return 1.f;
    return length_squared(cross(towards, photon.towards)) / size2;
}

// What a photon would be as a kernel, were its light to come from that distance.
GuideCell::Kernel kernel_at(float distance, std::size_t self, std::span<const CausticPhoton> photons)
{
    const Vec3f source = source_of(photons[self], distance);
    std::array<float, neighbours> nearest;
    nearest.fill(1.f);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        if (i == self) continue;
        float value = miss(source, photons[i]);
        for (float& other : nearest)
            if (value < other) std::swap(value, other);
    }
    return {source, nearest.back()};
}

GuideCell::Kernel kernel_of(std::size_t self, std::span<const CausticPhoton> photons)
{
    const GuideCell::Kernel near = kernel_at(photons[self].to_last, self, photons);
    const GuideCell::Kernel far = kernel_at(photons[self].to_emitter, self, photons);
    GuideCell::Kernel best = far.sine_squared < near.sine_squared ? far : near;
    best.sine_squared = std::clamp(best.sine_squared * sqr(reach), sqr(narrowest), sqr(widest));
    return best;
}

Box3f box_of(std::span<const CausticPhoton> photons)
{
    Box3f box;
    for (const CausticPhoton& photon : photons) box.extendBy(photon.position);
    return box;
}

// Photons per unit area, roughly (a square has half its squared diagonal): how much light arrives in a cell.
double brightness(std::span<const CausticPhoton> photons)
{
    const double diagonal2 =
        photons.empty() ? 0.0 : static_cast<double>(length_squared(box_of(photons).size()));
    return diagonal2 > 0.0 ? 2.0 * static_cast<double>(photons.size()) / diagonal2 : 0.0;
}

// Guided directions are worth their rays where there is light: the noise that they remove goes with it. Measured on two scenes, for
// exponents between 1/4 and 1.
float strength_of(double brightness, double median)
{
    constexpr double weakest = 1.0 / 3.0;
    constexpr double strongest = GuideCell::most_directions;
    if (!(median > 0.0)) return 1.f;
    const double root = std::sqrt(brightness / median);
    return static_cast<float>(std::clamp(root * std::sqrt(root), weakest, strongest)); // to the power of 3/4
}

// Light of shiny links is found by emitter samples, too, so that it has less noise without a guide, and where other light outshines it
// its noise is not seen. Of directions that such photons have taught only so many are worth their rays. light: irradiance of the
// cell's photons. The second moment of what finds it unguided is light^2 gain, roughly, for gain is about pi times the density of
// the kernels where light arrives; that of other light goes with its square. Measured on five scenes, between 0.2 and 1.2.
float worth_of_rays(std::span<const CausticPhoton> photons, double light, double gain)
{
    constexpr double least_ratio = 0.3;
    double direct = 0.0;
    double glossy = 0.0;
    for (const CausticPhoton& photon : photons) {
        direct += static_cast<double>(photon.irradiance);
        glossy += photon.is_glossy ? 1.0 : 0.0;
    }
    const auto count = static_cast<double>(photons.size());
    const double needed = least_ratio * direct / count;
    const double noise = light * std::sqrt(gain);
    return noise < needed ? static_cast<float>(1.0 - glossy / count * (1.0 - noise / needed)) : 1.f;
}

// What a cell has, and what it does for its photons.
struct Learnt {
    GuideCell cell;
    double gain = 0.0;
};

Learnt learn_cell(std::span<const CausticPhoton> photons)
{
    Learnt learnt;
    std::vector<GuideCell::Kernel> kernels(photons.size());
    for (std::size_t i = 0; i < photons.size(); ++i) kernels[i] = kernel_of(i, photons);
    for (const GuideCell::Kernel& kernel : kernels) learnt.cell.add(kernel);
    learnt.cell.complete();
    // A photon stands for light times cosine, so that the second moment of f / p is a sum of cosine / p over photons. Each
    // judges the kernels of the others; what is not guided is cosine / pi.
    double guided = 0.0;
    double unguided = 0.0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
        GuideCell others;
        for (std::size_t k = 0; k < photons.size(); ++k)
            if (k != i) others.add(kernels[k]);
        others.complete();
        const double cosine = photons[i].cosine;
        const double pdf = static_cast<double>(others.pdf(photons[i].position, photons[i].towards));
        unguided += pi_d;
        guided += cosine / (cosine / pi_d + pdf + 1e-6);
    }
    learnt.gain = unguided / guided;
    return learnt;
}

} // namespace

class GuideBuilder {
public:
    explicit GuideBuilder(CausticPhotons found) : photons_(std::move(found.photons)), flux_(found.flux) {}

    void build(CausticGuide& guide, int threads)
    {
        std::vector<Vec3f> points;
        for (const CausticPhoton& photon : photons_) points.push_back(photon.position);
        CellTree::Members members;
        guide.tree_ = CellTree(points, GuideCell::most_photons, members);
        const std::size_t nodes = guide.tree_.nodes();
        std::vector<std::vector<CausticPhoton>> parts(nodes); // none but of leaves
        for (std::size_t node = 0; node < nodes; ++node)
            if (guide.tree_.is_leaf(node))
                for (const std::uint32_t i : members.of(node)) parts[node].push_back(photons_[i]);
        std::vector<Learnt> learnt(nodes);
        parallel_for(nodes, threads, [&](std::size_t node) {
            const FlushDenormals flush;
            if (parts[node].size() >= fewest_photons) learnt[node] = learn_cell(parts[node]);
        });
        std::vector<double> brightnesses(nodes);
        std::vector<double> of_leaves;
        for (std::size_t node = 0; node < nodes; ++node) {
            if (!guide.tree_.is_leaf(node)) continue;
            of_leaves.push_back(brightnesses[node] = brightness(parts[node]));
        }
        const double usual = median(std::move(of_leaves));
        const auto helps = [](const Learnt& one) { return one.gain >= least_gain; };
        guide.cells_.reserve(static_cast<std::size_t>(std::count_if(learnt.begin(), learnt.end(), helps)));
        guide.leaves_.resize(nodes);
        for (std::size_t node = 0; node < nodes; ++node) {
            if (!helps(learnt[node])) continue;
            GuideCell& cell = guide.cells_.emplace_back(learnt[node].cell);
            const double light = brightnesses[node] * flux_;
            cell.complete(strength_of(brightnesses[node], usual) *
                          worth_of_rays(parts[node], light, learnt[node].gain));
            guide.leaves_[node] = {reach_of(parts[node]), &cell};
        }
        guide.facts_.cells = guide.cells_.size();
    }

private:
    static double median(std::vector<double> values)
    {
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    }

    static Box3f reach_of(const std::vector<CausticPhoton>& photons)
    {
        const Box3f box = box_of(photons);
        const Vec3f margin(0.5f * length(box.size()));
        return Box3f(box.min - margin, box.max + margin);
    }

    std::vector<CausticPhoton> photons_;
    double flux_; // of each
};

CausticGuide CausticGuide::learn(const Scene& scene, std::size_t photons, int threads)
{
    const auto start = std::chrono::steady_clock::now();
    CausticGuide guide;
    CausticPhotons found = trace_caustic_photons(scene, photons, threads);
    guide.facts_.emitted = found.emitted;
    guide.facts_.arrived = found.photons.size();
    if (!found.photons.empty()) GuideBuilder(std::move(found)).build(guide, threads);
    guide.facts_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return guide;
}

} // namespace plumb
