// SPDX-License-Identifier: MIT

// [1] Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2

#include "integrators/delta_chain.h"
#include "integrators/direct_technique.h"
#include "model/plugin.h"
#include "plumb/model/integrator.h"

namespace plumb {

/// Emission and direct light, by two techniques of your choice under multiple importance sampling.
///
/// The multi-sample model of Veach 1997, section 9.2: a sample x of technique i has weight
/// (n_i p_i(x))^b / sum_k (n_k p_k(x))^b with b = 2 (power) or 1 (balance). Point and directional lights are sampled
/// apart, once each.
///
///     measure1     string    the first technique: area, solid-angle, hemisphere or bsdf   (default area)
///     measure2     string    the second technique, another one   (default bsdf)
///     nSamples1    integer   samples of the first technique at each surface point   (default 1)
///     nSamples2    integer   samples of the second technique   (default 1)
///     warp-type1   string    for measure1 hemisphere: cosine-hemisphere, uniform-hemisphere or none   (default none: cosine)
///     warp-type2   string    for measure2 hemisphere: cosine-hemisphere, uniform-hemisphere or none   (default none: cosine)
///     heuristic    string    power or balance   (default power)
///
///         <integrator type="direct-mis">
///             <string name="measure1" value="solid-angle"/>
///             <string name="measure2" value="bsdf"/>
///         </integrator>
class DirectMisConfigured final : public Integrator, public SingleDiscreteBounce {
public:
    explicit DirectMisConfigured(const Params& params)
        : first_(params, "measure1", "nSamples1", "warp-type1", DirectTechnique::Kind::area),
          second_(params, "measure2", "nSamples2", "warp-type2", DirectTechnique::Kind::bsdf),
          heuristic_(heuristic_of(params))
    {
        if (first_.kind() == second_.kind())
            params.fail("measure2",
                        "must differ from measure1; to use one technique alone there is 'direct'");
    }

    void prepare(const Scene& scene) override
    {
        first_.prepare(scene);
        second_.prepare(scene);
    }

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        return trace_path(*this, tracer, sampler, ray);
    }

    std::string bias() const override { return bias_of_depth(max_depth()); }
    bool notes_light() const override { return true; }

    Color direct(Tracer& tracer, Sampler& sampler, const Vertex& vertex) const
    {
        if (!vertex.has_smooth_lobes()) return Color(0.f);
        Color sum = light_from_all_delta_emitters(tracer, sampler, vertex);
        for (const auto& [mine, other] : {std::pair(&first_, &second_), std::pair(&second_, &first_)}) {
            const std::size_t noted = tracer.noted_light();
            const Color found = part(tracer, sampler, vertex, *mine, *other);
            tracer.change_noted_light(noted, [&](const Color& part) { return sum + part; });
            sum += found;
        }
        return sum;
    }

private:
    // What the samples of `mine` add.
    Color part(Tracer& tracer, Sampler& sampler, const Vertex& vertex, const DirectTechnique& mine,
               const DirectTechnique& other) const
    {
        Color sum(0.f);
        const auto samples = static_cast<float>(mine.samples());
        for (int i = 0; i < mine.samples(); ++i) {
            mine.find(tracer, sampler, vertex, other, [&](const DirectTechnique::Found& found) {
                const float share = mis_weight(heuristic_, samples * found.pdf,
                                               static_cast<float>(other.samples()) * found.other_pdf);
                sum += found.light * (share / (samples * found.pdf));
                tracer.note_light(sum, found.by, found.emitter);
            });
        }
        return sum;
    }

    DirectTechnique first_;
    DirectTechnique second_;
    Heuristic heuristic_;
};

template std::unique_ptr<Integrator> build<DirectMisConfigured>(const Params&);

} // namespace plumb
