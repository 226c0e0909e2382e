// SPDX-License-Identifier: MIT
#include "scene_file/face_bsdfs.h"

#include "bsdfs/by_face.h"
#include "plumb/model/bsdf.h"
#include "scene_file/build_child.h"
#include "scene_file/mtl_bsdf.h"
#include "scene_file/shared_objects.h"

#include <algorithm>
#include <list>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::size_t most_libraries = 64;

class ShapeBsdfBuilder {
public:
    ShapeBsdfBuilder(const Element& shape, FaceMaterials materials, LoadContext& context)
        : shape_(shape), materials_(std::move(materials)), context_(context)
    {}

    ShapeBsdf build()
    {
        sort_children();
        if (named_.empty() && (rest_ || !reads_libraries())) return whole();
        if (reads_libraries()) read_libraries();
        std::vector<std::shared_ptr<const Bsdf>> bsdfs;
        for (const std::string& name : materials_.names) bsdfs.push_back(of_material(name));
        std::vector<std::uint32_t>& faces = materials_.of_primitive;
        if (std::find(faces.begin(), faces.end(), FaceMaterials::none) != faces.end()) {
            std::replace(faces.begin(), faces.end(), FaceMaterials::none,
                         static_cast<std::uint32_t>(bsdfs.size()));
            bsdfs.push_back(of_rest());
        }
        report();
        if (std::find(bsdfs.begin(), bsdfs.end(), nullptr) != bsdfs.end()) return {};
        const std::string name = fmt::format("the materials of {}", place_name(shape_));
        if (faces.empty()) return {bsdfs.front(), name};
        return {bsdf_by_face(std::move(bsdfs), std::move(faces)), name};
    }

private:
    // By the names of materials where the file has them. A single child without such a name is for all faces.
    void sort_children()
    {
        std::vector<const Element*> children;
        for (const Element& child : shape_.children) {
            if (child.tag == "bsdf" || child.tag == "ref") children.push_back(&child);
            emits_ = emits_ || child.tag == "emitter";
        }
        for (const Element* child : children) {
            std::string name = child->value("name");
            if (!is_material(name) && children.size() > 1) name = child->value("id");
            if (is_material(name) && named_.emplace(name, child).second) continue;
            keep_only(rest_, *child, context_.diagnostics);
        }
    }

    bool is_material(const std::string& name) const
    {
        return std::find(materials_.names.begin(), materials_.names.end(), name) != materials_.names.end();
    }

    bool reads_libraries() const
    {
        return !rest_ && !emits_ && !materials_.libraries.empty() && !materials_.names.empty();
    }

    ShapeBsdf whole()
    {
        if (materials_.names.size() > 1)
            warn(fmt::format("the faces name {} materials (usemtl): all use {}", materials_.names.size(),
                             rest_ ? "the one BSDF of this shape" : "the default BSDF"));
        return {of_rest(), name_of_rest()};
    }

    std::shared_ptr<const Bsdf> of_rest()
    {
        if (rest_) return build_bsdf(*rest_, context_);
        if (!default_)
            default_ =
                ObjectReader(synthetic_element(shape_, "bsdf", "diffuse"), context_).build(bsdf_types());
        return default_;
    }

    std::string name_of_rest() const
    {
        if (!rest_) return "bsdf 'diffuse' (default)";
        const std::string id = rest_->value("id"); // its own, or that of a <ref>
        return id.empty() ? place_name(*rest_) : id;
    }

    std::shared_ptr<const Bsdf> of_material(const std::string& name)
    {
        if (const auto given = named_.find(name); given != named_.end())
            return build_bsdf(*given->second, context_);
        if (rest_ || !reads_libraries()) return of_rest();
        const auto described = described_.find(name);
        if (described == described_.end()) {
            if (has_library_) remarks_["no MTL file describes it; it is diffuse, 0.5"].push_back(name);
            return of_rest();
        }
        MtlBsdf made = bsdf_of_mtl(*described->second.material, shape_, described->second.directory);
        for (std::string& remark : made.remarks) remarks_[std::move(remark)].push_back(name);
        elements_.push_back(std::move(made.bsdf));
        return build_bsdf(elements_.back(), context_);
    }

    // --- MTL files ---

    struct Described {
        const MtlMaterial* material;
        std::filesystem::path directory;
    };

    void read_libraries()
    {
        for (std::size_t i = 0; i < std::min(materials_.libraries.size(), most_libraries); ++i) {
            const std::string& line = materials_.libraries[i];
            if (read_library(line)) continue;
            // Several names, between blanks; each of them may be missing.
            std::size_t begin = 0;
            bool any = false;
            while (begin < line.size() && line.find(' ') != line.npos) {
                const std::size_t end = std::min(line.find(' ', begin), line.size());
                any = (end > begin && read_library(line.substr(begin, end - begin))) || any;
                begin = end + 1;
            }
            if (!any)
                warn(fmt::format("the MTL file '{}' does not exist; its materials are diffuse, 0.5", line));
        }
    }

    // Whether there is one.
    bool read_library(std::string name)
    {
        std::replace(name.begin(), name.end(), '\\', '/');
        const std::filesystem::path file = materials_.directory / name;
        std::error_code status;
        if (name.empty() || !std::filesystem::is_regular_file(file, status)) return false;
        has_library_ = true;
        context_.add_file(file);
        try {
            files_.push_back(read_mtl(file));
        } catch (const Error& error) {
            warn(fmt::format("{}; its materials are diffuse, 0.5", error.what()));
            return true;
        }
        for (const MtlMaterial& material : files_.back())
            described_.try_emplace(material.name, Described{&material, file.parent_path()});
        return true;
    }

    // One warning for each remark, with some of the materials that it is about.
    void report()
    {
        constexpr std::size_t most = 3;
        for (const auto& [remark, names] : remarks_) {
            std::string list;
            for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
                list += fmt::format("{}'{}'", i == 0 ? "" : ", ", names[i]);
            if (names.size() > most) list += fmt::format(" and {} more", names.size() - most);
            warn(fmt::format("material{} {}: {}", names.size() > 1 ? "s" : "", list, remark));
        }
    }

    // Where the mesh's file is named.
    void warn(const std::string& message)
    {
        SourceLocation at = shape_.place();
        for (const Element& child : shape_.children)
            if (child.value("name") == "filename" && child.attribute("value"))
                at = child.value_place(*child.attribute("value"));
        context_.diagnostics.warning(at, message);
    }

    const Element& shape_;
    FaceMaterials materials_;
    LoadContext& context_;
    bool emits_ = false;
    std::map<std::string, const Element*> named_; // by material
    const Element* rest_ = nullptr;               // for all other faces
    std::shared_ptr<const Bsdf> default_;
    bool has_library_ = false;
    std::list<std::vector<MtlMaterial>> files_;
    std::map<std::string, Described> described_;
    std::list<Element> elements_;
    std::map<std::string, std::vector<std::string>> remarks_;
};

} // namespace

ShapeBsdf build_shape_bsdf(const Element& shape, FaceMaterials materials, LoadContext& context)
{
    return ShapeBsdfBuilder(shape, std::move(materials), context).build();
}

std::string place_name(const Element& element)
{
    const SourceLocation at = element.place();
    return fmt::format("{} '{}' ({}:{})", element.written_tag(), element.written_type(),
                       std::filesystem::path(at.file).filename().string(), at.line);
}

} // namespace plumb
