// SPDX-License-Identifier: MIT

// Chooses the maps of src/samplers/sobol_maps.h, and prints them as they stand there.
//
//     sobol_maps [SEED]     (default 1; takes some minutes)
//
// Sets are added one after the other, and of each set the columns of its map, with the best of random candidates kept at
// each step. Candidates are judged by what the first 2^m points make of the estimate of integrands that depend on some of
// the coordinates together (`wanted` below).
//
// [1] Owen 1997, "Monte Carlo Variance of Scrambled Net Quadrature", SIAM J. Numer. Anal. 34(5)
// [2] Dick and Pillichshammer 2010, "Digital Nets and Sequences", sections 13.3 and 13.5

#include "samplers/sobol_maps.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace {

using namespace plumb;

enum Set : std::size_t { film, lens, direction1, light1, direction2, light2 };
constexpr std::size_t dimensions =
    4; // of a set: a pair, then two single numbers, the first of which chooses a light
constexpr std::size_t choice = 2;

struct Coordinate {
    std::size_t set;
    std::size_t dimension;
};

// An integrand that depends on all of these coordinates, and on every group of them.
struct Projection {
    double weight;
    std::vector<Coordinate> coordinates;
};

// The pairs of some sets, and single coordinates.
Projection pairs(double weight, std::initializer_list<Set> sets, std::initializer_list<Coordinate> more = {})
{
    Projection projection{weight, {}};
    for (const Set set : sets)
        for (std::size_t dimension = 0; dimension < 2; ++dimension)
            projection.coordinates.push_back({set, dimension});
    projection.coordinates.insert(projection.coordinates.end(), more.begin(), more.end());
    return projection;
}

// How a path depends on its numbers: direct light on film, light and the choice of a light; what comes by a bounce on
// film, direction and light or direction at the second vertex. What is not multiplied with each other only should not be
// worse than chance.
std::vector<Projection> wanted(Set set)
{
    constexpr double weak = 0.15;
    const Coordinate choice1{light1, choice};
    const Coordinate choice2{light2, choice};
    switch (set) {
    case film: break;
    case light1:
        return {pairs(5.0, {film, light1}),      pairs(1.0, {film, light1}, {choice1}),
                pairs(1.0, {film}, {choice1}),   {0.3, {{film, 0}, {light1, 0}}},
                {0.3, {{film, 0}, {light1, 1}}}, {0.3, {{film, 1}, {light1, 0}}},
                {0.3, {{film, 1}, {light1, 1}}}, {0.5, {{film, 0}, choice1}},
                {0.5, {{film, 1}, choice1}}};
    case direction1:
        return {pairs(2.0, {film, direction1}),      pairs(0.3, {film, direction1}, {{direction1, choice}}),
                {0.3, {{film, 0}, {direction1, 0}}}, {0.3, {{film, 0}, {direction1, 1}}},
                {0.3, {{film, 1}, {direction1, 0}}}, {0.3, {{film, 1}, {direction1, 1}}},
                pairs(weak, {direction1, light1}),   pairs(weak, {direction1}, {choice1})};
    case light2:
        return {pairs(1.0, {film, direction1, light2}),
                pairs(0.7, {direction1, light2}),
                pairs(0.3, {film, light2}),
                pairs(0.5, {direction1, light2}, {choice2}),
                pairs(0.5, {direction1}, {choice2}),
                pairs(weak, {light1, light2})};
    case direction2:
        return {pairs(1.0, {film, direction1, direction2}), pairs(0.7, {direction1, direction2}),
                pairs(0.3, {film, direction2}), pairs(weak, {direction2, light2}),
                pairs(weak, {direction2, light1})};
    case lens:
        return {pairs(1.0, {film, lens}),
                pairs(1.0, {film, lens, light1}),
                pairs(1.0, {film, lens, direction1}),
                pairs(0.5, {lens, light1}),
                pairs(0.5, {lens, direction1}),
                pairs(weak, {lens, light2}),
                pairs(weak, {lens, direction2})};
    }
    return {};
}

// The shape of integrands: what share of the variance in one coordinate lies in its binary digit l, as q^l.
struct Integrand {
    double q;
    double q_of_choice; // among many lights: fine and not smooth

    // [2], section 13.3: the mean over Owen's scramblings of what two points have in common whose coordinates have so many
    // leading bits alike, of 32. 1 where they are equal; 0 in the mean.
    double kernel(std::size_t dimension, std::size_t alike) const
    {
        const double ratio = dimension < choice ? q : q_of_choice;
        return alike == 32 ? 1.0 : 1.0 - (2.0 - ratio) * std::pow(ratio, static_cast<double>(alike));
    }
};
constexpr Integrand integrands[] = {{0.5, 0.95}, {0.3, 0.8}}; // with edges, and smooth
constexpr double interaction = 0.5; // the variance of a product of coordinates falls by this for each of them

// A map as columns, from the end.
using Map = std::vector<std::uint32_t>;

// The factors of a coordinate's products, of so many points: the first ones, with what they are to be moved by.
std::vector<double> factors(const Map& map, std::size_t dimension, const Integrand& integrand,
                            std::size_t points, std::uint32_t offset)
{
    constexpr std::size_t levels = 33;
    std::array<double, levels> by_level;
    for (std::size_t level = 0; level < levels; ++level)
        by_level[level] = 1.0 + interaction * integrand.kernel(dimension, level);
    std::vector<std::uint32_t> places{sobol_point(offset)[dimension]};
    places.reserve(points);
    for (std::size_t k = 0; places.size() < points; ++k) {
        const std::uint32_t added = sobol_point(map[k])[dimension];
        for (std::size_t i = 0, count = places.size(); i < count; ++i) places.push_back(places[i] ^ added);
    }
    std::vector<double> result;
    result.reserve(points);
    for (const std::uint32_t place : places)
        result.push_back(by_level[static_cast<std::size_t>(std::countr_zero(place))]);
    return result;
}

class Search {
public:
    explicit Search(std::uint64_t seed) : random_(seed)
    {
        for (std::size_t k = 0; k < chosen_columns; ++k) maps_[film].push_back(column(1, k));
    }

    void choose(Set set)
    {
        prepare(set);
        std::vector<Candidate> kept{Candidate{{}, std::vector<double>(terms_.size(), 0.0), 0.0}};
        for (Candidate& candidate : kept)
            for (std::size_t t = 0; t < terms_.size(); ++t) candidate.sums[t] = terms_[t].at_zero;
        for (std::size_t m = 0; m < chosen_columns; ++m) {
            std::vector<Candidate> candidates = extended(kept, m);
            judge(candidates, m);
            const std::size_t count = std::min(candidates.size(), beam);
            std::partial_sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count),
                              candidates.end(),
                              [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
            candidates.resize(count);
            kept = std::move(candidates);
        }
        maps_[set] = kept.front().map;
    }

    void print() const
    {
        for (const Map& map : maps_) {
            std::printf("    {");
            for (std::size_t k = 0; k < map.size(); ++k)
                std::printf("%s%u", k == 0 ? "" : ", ", map[k] >> (index_bits - 1 - k));
            std::printf("},\n");
        }
    }

private:
    static constexpr std::size_t beam = 80;
    static constexpr std::size_t tries = 160;

    struct Candidate {
        Map map;
        std::vector<double> sums; // of each term over the points so far
        double cost;
    };

    // A projection with an integrand.
    struct Term {
        double weight;
        double at_zero;             // the product at the point 0
        std::vector<double> others; // products of the coordinates that are chosen already, of all points
        std::vector<std::size_t> dimensions; // of the set that is being chosen
        const Integrand* integrand;
    };

    // rows: as in sobol_maps.h.
    static std::uint32_t column(std::uint32_t rows, std::size_t k) { return rows << (index_bits - 1 - k); }

    void prepare(Set set)
    {
        constexpr std::uint32_t points = std::uint32_t{1} << chosen_columns;
        terms_.clear();
        for (const Projection& projection : wanted(set))
            for (const Integrand& integrand : integrands) {
                Term term{projection.weight, 1.0, std::vector<double>(points, 1.0), {}, &integrand};
                for (const auto& [of, dimension] : projection.coordinates) {
                    term.at_zero *= 1.0 + interaction;
                    if (of == set) {
                        term.dimensions.push_back(dimension);
                        continue;
                    }
                    const auto more = factors(maps_[of], dimension, integrand, points, 0);
                    for (std::uint32_t i = 0; i < points; ++i) term.others[i] *= more[i];
                }
                terms_.push_back(std::move(term));
            }
    }

    std::vector<Candidate> extended(const std::vector<Candidate>& kept, std::size_t k)
    {
        const std::uint32_t all = std::uint32_t{1} << k;
        std::vector<Candidate> candidates;
        for (const Candidate& candidate : kept)
            for (std::uint32_t i = 0; i < std::min<std::uint32_t>(all, tries); ++i) {
                const std::uint32_t upper = all <= tries ? i : static_cast<std::uint32_t>(random_() % all);
                candidates.push_back(candidate);
                candidates.back().map.push_back(column(upper << 1 | 1, k));
            }
        return candidates;
    }

    // Adds to the costs what 2^(m + 1) points make of each term: the root of its variance over the least one found.
    void judge(std::vector<Candidate>& candidates, std::size_t m) const
    {
        const std::uint32_t half = std::uint32_t{1} << m;
        const double points = 2.0 * half;
        std::vector<double> least(terms_.size(), std::numeric_limits<double>::infinity());
        for (Candidate& candidate : candidates) {
            std::vector<double> factor[std::size(integrands)][dimensions];
            for (std::size_t t = 0; t < terms_.size(); ++t) {
                const Term& term = terms_[t];
                std::vector<double> products(term.others.begin() + half, term.others.begin() + 2 * half);
                for (const std::size_t dimension : term.dimensions) {
                    auto& mine = factor[term.integrand - integrands][dimension];
                    if (mine.empty())
                        mine = factors(candidate.map, dimension, *term.integrand, half, candidate.map[m]);
                    for (std::uint32_t i = 0; i < half; ++i) products[i] *= mine[i];
                }
                for (const double product : products) candidate.sums[t] += product;
                least[t] = std::min(least[t], gain(candidate, t, points));
            }
        }
        for (Candidate& candidate : candidates)
            for (std::size_t t = 0; t < terms_.size(); ++t) {
                const double found = gain(candidate, t, points);
                candidate.cost += terms_[t].weight * std::sqrt(found / least[t]);
                candidate.cost += worse_than_chance * std::max(found - nearly_chance, 0.0);
            }
    }
    static constexpr double worse_than_chance = 10.0;
    static constexpr double nearly_chance = 0.75;

    // [1]: the variance over that of as many independent points.
    double gain(const Candidate& candidate, std::size_t t, double points) const
    {
        constexpr double least = 1e-5; // below, rounding decides
        return std::max((candidate.sums[t] - points) / (terms_[t].at_zero - 1.0), least);
    }

    std::mt19937_64 random_;
    std::array<Map, mapped_sets> maps_;
    std::vector<Term> terms_;
};

} // namespace

int main(int argc, char** argv)
{
    Search search(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1);
    for (const Set set : {light1, direction1, light2, direction2, lens}) search.choose(set);
    search.print();
}
