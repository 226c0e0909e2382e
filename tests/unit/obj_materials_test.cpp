// SPDX-License-Identifier: MIT

// The BSDFs of the faces of an OBJ mesh: by name from the scene, else from the MTL file.

#include "plumb/model/bsdf.h"
#include "plumb/model/shape.h"
#include "plumb/shapes/mtl.h"
#include "scene_file/mtl_bsdf.h"
#include "support/catch.h"
#include "support/element_text.h"
#include "support/scene_text.h"

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

// Two triangles, of the materials red and green.
const std::string mesh = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"
                         "usemtl green\nf 1 3 4\n";
const std::string mtl = "newmtl red\nKd 0.8 0.1 0.1\nnewmtl green\nKd 0.1 0.6 0.1\nillum 1\nKs 1 1 1\nNs 9\n";

std::string diffuse(const std::string& attributes, double albedo)
{
    return fmt::format("<bsdf type='diffuse' {0}><color name='albedo' value='{1} {1} {1}'/></bsdf>",
                       attributes, albedo);
}

struct Faces {
    std::vector<Color> albedo; // of each triangle, straight on
    std::string warnings;
};

// mtl: empty: there is no such file.
Faces load_faces(const std::string& inner, const std::string& obj_text = mesh,
                 const std::string& mtl_text = mtl, const std::string& dialect = "plumb")
{
    const TempDirectory directory;
    directory.write("m.obj", obj_text);
    if (!mtl_text.empty()) directory.write("m.mtl", mtl_text);
    const LoadedScene loaded = load_scene(
        directory.write("scene.xml", "<scene dialect='" + dialect + "'><integrator type='normals'/>" +
                                         camera + "<mesh type='obj'><string name='filename' value='m.obj'/>" +
                                         inner + "</mesh></scene>"));
    Faces faces;
    const SceneObject& object = loaded.job.scene->objects().front();
    for (std::uint32_t i = 0; i < object.shape->triangle_count(); ++i) {
        SurfacePoint at;
        at.primitive = i;
        const Vec3f up(0.f, 0.f, 1.f);
        faces.albedo.push_back(object.bsdf->evaluate(at, up, up).f_cos * static_cast<float>(pi_d));
    }
    for (const Diagnostic& warning : loaded.warnings) faces.warnings += warning.message + "\n";
    return faces;
}

void check_near(const Color& a, const Color& b)
{
    CHECK(a[0] == Approx(b[0]));
    CHECK(a[1] == Approx(b[1]));
    CHECK(a[2] == Approx(b[2]));
}

void check_faces(const Faces& faces, const Color& first, const Color& second,
                 const std::string& warnings = "")
{
    REQUIRE(faces.albedo.size() == 2);
    check_near(faces.albedo[0], first);
    check_near(faces.albedo[1], second);
    CHECK(faces.warnings == warnings);
}

const Color red(0.8f, 0.1f, 0.1f), green(0.1f, 0.6f, 0.1f);

// Of one material, as text.
std::string mapped(const std::string& text, std::vector<std::string>* remarks = nullptr)
{
    const TempDirectory directory;
    directory.write("wood.png", "");
    const auto materials = read_mtl(directory.write("m.mtl", "newmtl a\n" + text));
    REQUIRE(materials.size() == 1);
    Diagnostics diagnostics;
    const auto at = parse_document("scene.xml", "<scene/>", diagnostics);
    MtlBsdf made = bsdf_of_mtl(materials.front(), *at, directory.path());
    if (remarks) *remarks = made.remarks;
    std::string bsdf = text_of(made.bsdf);
    const std::string folder = std::filesystem::absolute(directory.path()).string() + "/";
    for (std::size_t i = bsdf.find(folder); i != bsdf.npos; i = bsdf.find(folder))
        bsdf.erase(i, folder.size());
    return bsdf;
}

} // namespace

TEST_CASE("a mesh without a BSDF has the materials of its MTL file", "[unit][obj][materials]")
{
    check_faces(load_faces(""), red, green);
    // Not for the courses, whose renderers do not read it; nor for meshes that emit.
    for (const char* course : {"epfl", "eth", "zaragoza", "mcgill"}) {
        CAPTURE(course);
        check_faces(load_faces("", mesh, mtl, course), Color(0.5f), Color(0.5f),
                    "the faces name 2 materials (usemtl): all use the default BSDF\n");
    }
    check_faces(load_faces("<emitter type='area'/>"), Color(0.5f), Color(0.5f),
                "the faces name 2 materials (usemtl): all use the default BSDF\n");
    check_faces(load_faces("<boolean name='materials' value='false'/>"), Color(0.5f), Color(0.5f),
                "the faces name 2 materials (usemtl): all use the default BSDF\n");
}

TEST_CASE("one BSDF without the name of a material is for all faces", "[unit][obj][materials]")
{
    const std::string warning = "the faces name 2 materials (usemtl): all use the one BSDF of this shape\n";
    check_faces(load_faces(diffuse("", 0.3)), Color(0.3f), Color(0.3f), warning);
    check_faces(load_faces(diffuse("name='other'", 0.3)), Color(0.3f), Color(0.3f), warning);
    check_faces(load_faces(diffuse("id='red'", 0.3)), Color(0.3f), Color(0.3f), warning);
}

TEST_CASE("BSDFs of a mesh belong to materials by name", "[unit][obj][materials]")
{
    check_faces(load_faces(diffuse("name='red'", 0.2) + diffuse("name='green'", 0.4)), Color(0.2f),
                Color(0.4f));
    check_faces(load_faces(diffuse("id='green'", 0.2) + diffuse("id='red'", 0.4)), Color(0.4f), Color(0.2f));
    check_faces(load_faces(diffuse("name='green'", 0.2)), red, Color(0.2f)); // else from the MTL
    check_faces(load_faces(diffuse("name='green'", 0.2) + diffuse("", 0.7)), Color(0.7f), Color(0.2f));
    check_faces(load_faces(diffuse("name='green'", 0.2), mesh, mtl, "eth"), Color(0.5f), Color(0.2f));
    CHECK_THROWS_WITH(load_faces(diffuse("", 0.2) + diffuse("", 0.7)), ContainsSubstring("a second <bsdf>"));
}

TEST_CASE("what an MTL file does not say is diffuse, with a warning", "[unit][obj][materials]")
{
    check_faces(load_faces("", mesh, ""), Color(0.5f), Color(0.5f),
                "the MTL file 'm.mtl' does not exist; its materials are diffuse, 0.5\n");
    check_faces(load_faces("", mesh, "newmtl red\nKd 0.8 0.1 0.1\n"), red, Color(0.5f),
                "material 'green': no MTL file describes it; it is diffuse, 0.5\n");
    check_faces(load_faces("", "mtllib no.mtl m.mtl\n" + mesh.substr(mesh.find("v 0"))), red, green);
    // Faces before the first usemtl.
    check_faces(load_faces("", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nusemtl red\nf 1 2 3\n"),
                Color(0.5f), red);
}

TEST_CASE("materials of MTL files become BSDFs", "[unit][obj][materials]")
{
    std::vector<std::string> remarks;
    CHECK(mapped("Kd 0.5 0.25 2\n", &remarks) ==
          "<bsdf type='diffuse'><color name='albedo' value='0.5 0.25 1'/></bsdf>");
    CHECK(remarks.empty());
    CHECK(mapped("Kd 0.5 0.5 0.5\nKs 0.25 0.25 0.25\nNs 50.4\nillum 2\n", &remarks) ==
          "<bsdf type='phong'><color name='diffuse-coefficients' value='0.5 0.5 0.5'/>"
          "<color name='specular-coefficients' value='0.25 0.25 0.25'/><integer name='exponent' "
          "value='50'/></bsdf>");
    CHECK(remarks == std::vector<std::string>{"Kd, Ks and Ns become 'phong'"});
    CHECK(mapped("Ni 1.5\nTf 0.5 1 1\nillum 7\nd 0.1\n") ==
          "<bsdf type='dielectric'><float name='intIOR' value='1.5'/><float name='extIOR' value='1'/>"
          "<color name='specularTransmittance' value='0.5 1 1'/></bsdf>");
    CHECK(mapped("Ks 0.5 0.5 0.5\nillum 3\n") ==
          "<bsdf type='conductor'><color name='specularReflectance' value='0.5 0.5 0.5'/></bsdf>");
    CHECK(mapped("Kd 1 1 1\nd 0.25\n") ==
          "<bsdf type='mask'><float name='opacity' value='0.25'/>"
          "<bsdf type='diffuse'><color name='albedo' value='1 1 1'/></bsdf></bsdf>");
    CHECK(mapped("Kd 1 1 1\nPr 0.25\nPm 0.5\n") ==
          "<bsdf type='principled'><color name='baseColor' value='1 1 1'/><float name='roughness' "
          "value='0.25'/>"
          "<float name='metallic' value='0.5'/><float name='sheen' value='0'/><float name='clearcoat' "
          "value='0'/>"
          "<float name='clearcoatGloss' value='1'/><float name='anisotropic' value='0'/></bsdf>");
    const std::string image = "<string name='filename' value='wood.png'/>";
    CHECK(mapped("map_Kd -s 2 3 1 -o 0.5 0 0 wood.png\n") ==
          "<bsdf type='diffuse'><texture type='bitmap' name='albedo'>" + image +
              "<transform name='toUv'><scale value='2 3 1'/><translate value='0.5 0 "
              "0'/></transform></texture></bsdf>");
    CHECK(mapped("norm wood.png\n") == "<bsdf type='normalmap'><texture type='bitmap' name='normal'>" +
                                           image +
                                           "<boolean name='raw' value='true'/></texture><bsdf type='diffuse'>"
                                           "<color name='albedo' value='0 0 0'/></bsdf></bsdf>");
    CHECK(mapped("map_Bump -bm 0.5 wood.png\n", &remarks) ==
          "<bsdf type='bumpmap'><texture type='bitmap' name='height'>" + image +
              "<boolean name='raw' value='true'/></texture><bsdf type='diffuse'><color name='albedo' "
              "value='0 0 0'/>"
              "</bsdf><float name='scale' value='0.5'/></bsdf>");
    // Ns 6: alpha = sqrt(2 / 8).
    CHECK(mapped("map_Kd wood.png\nKs 1 1 1\nNs 6\n", &remarks) ==
          "<bsdf type='roughplastic'><texture type='bitmap' name='diffuseReflectance'>" + image +
              "</texture><float name='alpha' value='0.5'/></bsdf>");
    CHECK(mapped("Kd 1 0 0\nmap_Kd no.png\nKe 1 1 1\n", &remarks) ==
          "<bsdf type='diffuse'><color name='albedo' value='1 0 0'/></bsdf>");
    CHECK(remarks == std::vector<std::string>{"Ke is not used; an <emitter> inside the mesh emits",
                                              "there is no image 'no.png'"});
}

TEST_CASE("numbers of MTL files are finite and in range", "[unit][obj][materials]")
{
    const TempDirectory directory;
    const auto materials = read_mtl(directory.write(
        "m.mtl", "Kd 9 9 9\nnewmtl a\nKd 1e999 -1 nan\nNs -5\nNi 1e300\nd 7\nPr x\nnewmtl\nKd 1 1 1\n"));
    REQUIRE(materials.size() == 1);
    const MtlMaterial& m = materials.front();
    for (const float x :
         {m.diffuse[0], m.diffuse[1], m.diffuse[2], m.exponent, m.index, m.dissolve, m.roughness}) {
        CHECK(std::isfinite(x));
        CHECK(x >= 0.f);
    }
    CHECK(m.dissolve <= 1.f);
    CHECK_THROWS_AS(read_mtl(directory.path() / "none.mtl"), Error);
}
