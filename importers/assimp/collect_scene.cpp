#include "importers/assimp/collect_scene.h"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace lightwell {
namespace {

/// Leaves only the reader of this extension, so that a damaged file is not tried by the others.
void keep_reader(Assimp::Importer& importer, const std::string& extension)
{
    std::vector<Assimp::BaseImporter*> others;
    for (std::size_t i = 0; i < importer.GetImporterCount(); ++i) {
        std::istringstream extensions(importer.GetImporterInfo(i)->mFileExtensions);
        bool ours = false;
        for (std::string one; extensions >> one;)
            ours = ours || one == extension;
        if (!ours)
            others.push_back(importer.GetImporter(i));
    }
    for (Assimp::BaseImporter* other : others)
        importer.UnregisterLoader(other);
}

Affine affine_of(const aiMatrix4x4& m)
{
    return {{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
}

std::array<float, 3> triple(const aiVector3D& v)
{
    return {v.x, v.y, v.z};
}

ForeignMaterial material_of(const aiMaterial& from)
{
    ForeignMaterial material;
    material.name = from.GetName().C_Str();
    aiColor3D colour;
    if (from.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == AI_SUCCESS) {
        material.diffuse = {colour.r, colour.g, colour.b};
        material.diffuse_stated = true;
    }
    if (from.Get(AI_MATKEY_COLOR_EMISSIVE, colour) == AI_SUCCESS)
        material.emission = {colour.r, colour.g, colour.b};
    float opacity = 1;
    if (from.Get(AI_MATKEY_OPACITY, opacity) == AI_SUCCESS)
        material.opacity = opacity;
    float shininess = 0;
    material.shiny = from.Get(AI_MATKEY_SHININESS, shininess) == AI_SUCCESS && shininess > 0;
    for (int type = aiTextureType_DIFFUSE; type <= AI_TEXTURE_TYPE_MAX; ++type)
        material.textures += from.GetTextureCount(static_cast<aiTextureType>(type));
    return material;
}

ForeignMesh mesh_of(const aiMesh& from)
{
    ForeignMesh mesh;
    mesh.name = from.mName.C_Str();
    mesh.material = from.mMaterialIndex;
    const auto numbers = [&](const aiVector3D* vectors, std::vector<float>& into) {
        for (unsigned i = 0; i < from.mNumVertices; ++i)
            into.insert(into.end(), {vectors[i].x, vectors[i].y, vectors[i].z});
    };
    if (from.HasPositions())
        numbers(from.mVertices, mesh.points);
    if (from.HasNormals())
        numbers(from.mNormals, mesh.normals);
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
        mesh.face_sizes.push_back(from.mFaces[i].mNumIndices);
        mesh.corners.insert(mesh.corners.end(), from.mFaces[i].mIndices,
                            from.mFaces[i].mIndices + from.mFaces[i].mNumIndices);
    }
    return mesh;
}

/// Depth first without recursion: a damaged file may nest without end.
void collect_nodes(const aiNode& root, ForeignScene& scene)
{
    struct Step {
        const aiNode* node;
        std::int32_t parent;
    };
    std::vector<Step> open{{&root, -1}};
    while (!open.empty()) {
        const Step step = open.back();
        open.pop_back();
        const auto number = static_cast<std::int32_t>(scene.nodes.size());
        scene.nodes.push_back({step.node->mName.C_Str(),
                               step.parent,
                               affine_of(step.node->mTransformation),
                               {step.node->mMeshes, step.node->mMeshes + step.node->mNumMeshes}});
        for (unsigned i = step.node->mNumChildren; i > 0; --i)
            open.push_back({step.node->mChildren[i - 1], number});
    }
}

void collect_statements(const aiMetadata& statements, ForeignScene& scene)
{
    float centimetres = 0;
    if (statements.Get("UnitScaleFactor", centimetres))
        scene.centimetres_per_unit = centimetres;
    statements.Get("UpAxis", scene.up_axis);
    statements.Get("UpAxisSign", scene.up_sign);
}

std::string whole_file(const std::string& file)
{
    std::ifstream in(file, std::ios::binary);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    if (!in)
        throw std::runtime_error("the file cannot be opened");
    return std::move(bytes).str();
}

} // namespace

ForeignScene collect_scene(const std::string& file, const std::string& extension)
{
    Assimp::Importer importer;
    keep_reader(importer, extension);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    const std::string bytes = whole_file(file);
    const aiScene* const from = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, extension.c_str());
    if (from == nullptr || from->mRootNode == nullptr)
        throw std::runtime_error(importer.GetErrorString());
    ForeignScene scene;
    for (unsigned i = 0; i < from->mNumMaterials; ++i)
        scene.materials.push_back(material_of(*from->mMaterials[i]));
    for (unsigned i = 0; i < from->mNumMeshes; ++i)
        scene.meshes.push_back(mesh_of(*from->mMeshes[i]));
    collect_nodes(*from->mRootNode, scene);
    for (unsigned i = 0; i < from->mNumCameras; ++i) {
        const aiCamera& camera = *from->mCameras[i];
        scene.cameras.push_back({camera.mName.C_Str(), triple(camera.mPosition), triple(camera.mLookAt),
                                 triple(camera.mUp), camera.mHorizontalFOV, camera.mAspect});
    }
    for (unsigned i = 0; i < from->mNumLights; ++i)
        scene.lights.push_back(from->mLights[i]->mName.C_Str());
    scene.animations = from->mNumAnimations;
    if (from->mMetaData != nullptr)
        collect_statements(*from->mMetaData, scene);
    return scene;
}

} // namespace lightwell
