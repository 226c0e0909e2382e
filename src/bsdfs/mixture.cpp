// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/bsdf.h"

#include <algorithm>
#include <charconv>
#include <numeric>

#include <fmt/format.h>

namespace plumb {

/// The weighted sum of several BSDFs. What the weights leave to 1 is absorbed.
///
///     weights   string   of the BSDFs, in the order of the file: numbers of at least 0, whose sum is at most 1
///
///         <bsdf type="mixture">
///             <string name="weights" value="0.5, 0.3, 0.1"/>
///             <bsdf type="diffuse"/>
///             <bsdf type="roughconductor"/>
///             <bsdf type="mirror"/>
///         </bsdf>
class Mixture final : public Bsdf {
public:
    explicit Mixture(const Params& params) : weights_(read_weights(params))
    {
        for (std::size_t i = 0; i < std::max<std::size_t>(params.bsdf_count(), 1); ++i)
            parts_.push_back(params.bsdf(i));
        weights_.resize(parts_.size(), 0.f);
        const float sum = std::accumulate(weights_.begin(), weights_.end(), 0.f);
        for (const float weight : weights_) chances_.push_back(sum > 0.f ? weight / sum : 0.f);
        is_black_ = !(sum > 0.f);
        for (const auto& part : parts_) lobes_ = lobes_ | part->lobes();
    }

    Lobes lobes() const override { return lobes_; }
    bool is_oriented() const override
    {
        return any([](const Bsdf& part) { return part.is_oriented(); });
    }
    bool has_back() const override
    {
        return any([](const Bsdf& part) { return part.has_back(); });
    }
    bool is_reciprocal() const override
    {
        return !any([](const Bsdf& part) { return !part.is_reciprocal(); });
    }
    bool conserves_energy() const override
    {
        return !any([](const Bsdf& part) { return !part.conserves_energy(); });
    }
    float opacity(const SurfacePoint& at) const override
    {
        float through = 0.f;
        for (std::size_t i = 0; i < parts_.size(); ++i)
            through += weights_[i] * (1.f - parts_[i]->opacity(at));
        return 1.f - through;
    }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        BsdfValue sum;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const BsdfValue value = parts_[i]->evaluate(at, wi, wo);
            sum.f_cos = sum.f_cos + value.f_cos * weights_[i];
            sum.pdf += value.pdf * chances_[i];
        }
        return sum;
    }

    // Delta lobes belong to the part that was chosen; a direction that several could have chosen counts for all.
    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        if (is_black_) return std::nullopt;
        std::size_t chosen = 0;
        while (chosen + 1 < parts_.size() && !(u_lobe < chances_[chosen])) u_lobe -= chances_[chosen++];
        const float chance = chances_[chosen];
        if (!(chance > 0.f)) return std::nullopt; // rounding, at the end
        auto sampled = parts_[chosen]->sample(at, wi, std::clamp(u_lobe / chance, 0.f, one_minus_epsilon), u);
        if (!sampled) return sampled;
        if (sampled->is_delta()) {
            sampled->weight = sampled->weight * (weights_[chosen] / chance);
            sampled->pdf *= chance;
            return sampled;
        }
        const BsdfValue value = evaluate(at, wi, sampled->wo);
        if (!(value.pdf > 0.f)) return std::nullopt;
        sampled->weight = value.f_cos / value.pdf;
        sampled->pdf = value.pdf;
        return sampled;
    }

private:
    static std::vector<float> read_weights(const Params& params)
    {
        const std::string text = params.string("weights");
        std::vector<float> weights;
        double sum = 0.0;
        constexpr const char* separators = ", ";
        for (std::size_t i = text.find_first_not_of(separators); i != text.npos;
             i = text.find_first_not_of(separators, i)) {
            const std::size_t end = std::min(text.find_first_of(separators, i), text.size());
            double weight = 0.0;
            const auto [rest, error] = std::from_chars(text.data() + i, text.data() + end, weight);
            if (error != std::errc() || rest != text.data() + end || !(weight >= 0.0)) {
                params.fail("weights",
                            fmt::format("must be numbers of at least 0, not '{}'", text.substr(i, end - i)));
                return {};
            }
            weights.push_back(static_cast<float>(weight));
            sum += weight;
            i = end;
        }
        if (!(sum <= 1.0 + 1e-5))
            params.fail("weights", fmt::format("must have a sum of at most 1, not {}", sum));
        if (weights.size() != params.bsdf_count() && params.has("weights"))
            params.fail("weights", fmt::format("must be {} numbers, one for each BSDF, not {}",
                                               params.bsdf_count(), weights.size()));
        return weights;
    }

    template <class Test>
    bool any(const Test& test) const
    {
        return std::any_of(parts_.begin(), parts_.end(), [&](const auto& part) { return test(*part); });
    }

    std::vector<float> weights_;
    std::vector<float> chances_; // in proportion to the weights
    std::vector<std::shared_ptr<const Bsdf>> parts_;
    Lobes lobes_;
    bool is_black_ = false;
};

template std::unique_ptr<Bsdf> build<Mixture>(const Params&);

} // namespace plumb
