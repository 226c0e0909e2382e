// SPDX-License-Identifier: MIT

// Types of forks that no table has, by the words that their names consist of: volumetric_photon_mapper, imageTextureSimple,
// roughDielectricBSDF. A name with a word that is not below remains unknown, so that it may be a misspelling.

#include "scene_file/folded_name.h"
#include "scene_file/fork_words.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace plumb {

namespace {

// In any name.
constexpr std::string_view fillers[] = {
    "simple", "new", "old", "my", "test", "full", "final", "basic", "advanced", "custom", "v",     "with",
    "and",    "of",  "the", "0",  "1",    "2",    "3",     "4",     "5",        "color",  "float", "rgb"};

struct Kind {
    std::string_view kind;
    std::span<const std::string_view> words;
};

constexpr std::string_view integrator_words[] = {
    "path",
    "paths",
    "pt",
    "trace",
    "tracer",
    "tracing",
    "integrator",
    "mis",
    "mi",
    "mats",
    "mat",
    "ems",
    "em",
    "nee",
    "bsdf",
    "brdf",
    "material",
    "emitter",
    "light",
    "lights",
    "lighting",
    "direct",
    "indirect",
    "illumination",
    "global",
    "gi",
    "naive",
    "brute",
    "force",
    "recursive",
    "iterative",
    "explicit",
    "implicit",
    "sampling",
    "sample",
    "importance",
    "multiple",
    "multi",
    "rr",
    "russian",
    "roulette",
    "power",
    "balance",
    "heuristic",
    "render",
    "renderer",
    "vol",
    "volume",
    "volumes",
    "volumetric",
    "medium",
    "media",
    "participating",
    "homogeneous",
    "heterogeneous",
    "homog",
    "heterog",
    "photon",
    "map",
    "mapper",
    "mapping",
    "progressive",
    "stochastic",
    "bidirectional",
    "bdpt",
    "guided",
    "guiding",
    "adaptive",
    "parallel",
};
constexpr std::string_view texture_words[] = {
    "image",   "img",    "png",     "jpg",     "jpeg",      "exr",     "hdr",    "bitmap",
    "picture", "file",   "texture", "tex",     "map",       "mapping", "normal", "normals",
    "bump",    "height", "albedo",  "diffuse", "roughness", "uv",      "mesh",   "3f"};
constexpr std::string_view emitter_words[] = {
    "env",     "environment", "environmental", "map",      "mapped", "mapping", "light",    "lighting",
    "emitter", "image",       "based",         "infinite", "hdr",    "hdri",    "ibl",      "sky",
    "box",     "dome",        "sphere",        "exr",      "png",    "texture", "textured", "source",
    "spot",    "point",       "directional",   "distant",  "area",   "mesh"};
constexpr std::string_view bsdf_words[] = {
    "bsdf",    "brdf",       "material",  "disney",   "principled", "rough",      "smooth", "microfacet",
    "ggx",     "beckmann",   "conductor", "metal",    "metallic",   "dielectric", "glass",  "thin",
    "lambert", "lambertian", "diffuse",   "textured", "texture",    "image",      "coated"};
constexpr std::string_view camera_words[] = {"perspective", "camera", "pinhole",    "thin", "lens",  "dof",
                                             "depth",       "field",  "projective", "blur", "focus", "bokeh"};
constexpr std::string_view sampler_words[] = {
    "sampler",    "sampling",   "adaptive", "independent", "random", "uniform",
    "halton",     "hammersley", "sobol",    "sequence",    "low",    "discrepancy",
    "stratified", "jittered",   "jitter",   "multi",       "blue",   "noise"};

constexpr Kind known_kinds[] = {
    {"integrator", integrator_words}, {"texture", texture_words},
    {"emitter", emitter_words},       {"bsdf", bsdf_words},
    {"camera", camera_words},         {"sampler", sampler_words},
};

// The rows of what a name may mean; the first whose words are all there counts.
struct Meaning {
    std::string_view kind;
    std::vector<std::string_view> any;     // one of these
    std::vector<std::string_view> also;    // and, unless it is empty, one of these
    std::vector<std::string_view> without; // and none of these
    TypeName row;
};

const std::vector<Meaning>& meanings()
{
    using Words = std::vector<std::string_view>;
    const Words media = {"vol",           "volume",      "volumes",       "volumetric", "medium", "media",
                         "participating", "homogeneous", "heterogeneous", "homog",      "heterog"};
    const Words paths = {"path", "paths", "pt", "trace", "tracer", "tracing", "global", "gi", "indirect"};
    const Words of_bsdf = {"mats", "mat", "bsdf", "brdf", "material"},
                rough = {"rough", "microfacet", "ggx", "beckmann"};
    const Words metals = {"conductor", "metal", "metallic"}, glasses = {"dielectric", "glass"};
    static const std::vector<Meaning> table = {
        {"integrator",
         {"photon", "bdpt", "bidirectional", "guided", "guiding"},
         {},
         {},
         {"integrator", "", "path_mis", other_way, "photonmapper"}},
        {"integrator", media, {}, {}, {"integrator", "", "path_mis", no_media, "photonmapper"}},
        {"integrator", paths, {}, {}, {"integrator", "", "path_mis", {}, "path_mis"}},
        {"integrator",
         {"direct"},
         of_bsdf,
         {"mis", "mi", "emitter", "light", "ems", "em"},
         {"integrator", "", "direct_mats", {}, "direct_mats"}},
        {"integrator",
         {"direct"},
         {"emitter", "light", "lights", "ems", "em", "nee"},
         {"mis", "mi"},
         {"integrator", "", "direct_ems", {}, "direct_ems"}},
        {"integrator", {"direct"}, {}, {}, {"integrator", "", "direct_mis", {}, "direct_lighting"}},
        {"texture",
         {"image", "img", "png", "jpg", "jpeg", "exr", "hdr", "bitmap", "picture", "file"},
         {},
         {},
         {"texture", "", "bitmap", {}, "bitmap"}},
        {"texture", {"normal", "normals", "bump", "height"}, {}, {}, {"texture", "", "bitmap", {}, "bitmap"}},
        {"emitter",
         {"env", "environment", "environmental", "hdr", "hdri", "ibl", "sky", "infinite"},
         {},
         {},
         {"emitter", "", "environment", {}, "envmap"}},
        {"emitter",
         {"image"},
         {"based", "light"},
         {"area", "mesh"},
         {"emitter", "", "environment", {}, "envmap"}},
        {"emitter",
         {"spot"},
         {},
         {"texture", "textured", "image", "map"},
         {"emitter", "", "spot", {}, "spot"}},
        {"emitter", {"directional", "distant"}, {}, {}, {"emitter", "", "directional", {}, "directional"}},
        {"emitter", {"point"}, {}, {}, {"emitter", "", "point", {}, "point"}},
        {"emitter",
         {"area", "mesh"},
         {},
         {"texture", "textured", "image", "map", "mapped"},
         {"emitter", "", "area", {}, "area"}},
        {"bsdf", {"disney", "principled"}, {}, {"thin"}, {"bsdf", "", "principled", {}, "disney"}},
        {"bsdf", glasses, rough, {"thin", "diffuse"}, {"bsdf", "", "roughdielectric", {}, "roughdielectric"}},
        {"bsdf", glasses, {"thin"}, rough, {"bsdf", "", "thindielectric", {}, "thindielectric"}},
        {"bsdf", glasses, {"diffuse", "lambert", "lambertian"}, {}, {"bsdf", "", "plastic", {}, "plastic"}},
        {"bsdf", glasses, {}, {}, {"bsdf", "", "dielectric", {}, "dielectric"}},
        {"bsdf", metals, rough, {}, {"bsdf", "", "roughconductor", {}, "roughconductor"}},
        {"bsdf", metals, {}, {}, {"bsdf", "", "conductor", {}, "conductor"}},
        {"bsdf", {"lambert", "lambertian", "diffuse"}, {}, {}, {"bsdf", "", "diffuse", {}, "diffuse"}},
        {"camera",
         {"thin", "lens", "dof", "depth", "bokeh", "focus", "perspective", "pinhole", "projective"},
         {},
         {},
         {"camera", "", "perspective", {}, "lens"}},
        {"sampler",
         {"halton", "hammersley", "sobol", "low"},
         {},
         {},
         {"sampler", "", "sobol", "this is rendered with 'sobol'", "sobol"}},
        {"sampler",
         {"stratified", "jittered", "jitter"},
         {},
         {},
         {"sampler", "", "stratified", "this is rendered with 'stratified'", "stratified"}},
        {"sampler",
         {"adaptive", "independent", "random", "uniform", "blue"},
         {},
         {},
         {"sampler", "", "independent", "this is rendered with 'independent'", "independent"}},
    };
    return table;
}

bool has(const std::vector<std::string_view>& words, std::string_view word)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool has_any(const std::vector<std::string_view>& words, const std::vector<std::string_view>& of)
{
    return std::any_of(of.begin(), of.end(), [&](std::string_view word) { return has(words, word); });
}

// The name as a sequence of known words, the longest first; empty: it is not one.
std::vector<std::string_view> words_in(std::string_view name, std::span<const std::string_view> known)
{
    // Where the word that begins at a place ends, if the name consists of words from there on; else 0.
    std::vector<std::size_t> end_of(name.size() + 1, 0);
    end_of[name.size()] = name.size();
    for (std::size_t begin = name.size(); begin-- > 0;)
        for (const auto words : {known, std::span<const std::string_view>(fillers)})
            for (const std::string_view word : words) {
                const std::size_t end = begin + word.size();
                if (name.substr(begin).starts_with(word) && end_of[end] != 0 && end > end_of[begin])
                    end_of[begin] = end;
            }
    std::vector<std::string_view> found;
    if (name.empty() || end_of[0] == 0) return found;
    for (std::size_t begin = 0; begin < name.size(); begin = end_of[begin])
        found.push_back(name.substr(begin, end_of[begin] - begin));
    return found;
}

} // namespace

const TypeName* guess_fork_type(std::string_view kind, std::string_view theirs)
{
    const auto* of_kind = std::find_if(std::begin(known_kinds), std::end(known_kinds),
                                       [&](const Kind& row) { return row.kind == kind; });
    if (of_kind == std::end(known_kinds)) return nullptr;
    const std::string name = folded(theirs);
    const std::vector<std::string_view> words = words_in(name, of_kind->words);
    for (const Meaning& meaning : meanings())
        if (meaning.kind == kind && has_any(words, meaning.any) &&
            (meaning.also.empty() || has_any(words, meaning.also)) && !has_any(words, meaning.without))
            return &meaning.row;
    return nullptr;
}

} // namespace plumb
