"""Material node trees as looks: which shader, which numbers, which picture."""

import os

from .lightwell_bridge.looks import Look

# Names of the sockets of the Principled shader, before and since Blender 4.
_SOCKETS = {"specular": ("Specular", "Specular IOR Level"), "transmission": ("Transmission", "Transmission Weight"),
            "emission": ("Emission", "Emission Color"), "strength": ("Emission Strength",)}


class LookReader:
    """Reads materials; `notes` collects what people should know, `pictures` makes a file of an image."""

    def __init__(self, notes, pictures):
        self.notes, self._pictures = notes, pictures

    def look_of(self, material, closed=False):
        """@param closed  whether the surfaces made of it are closed bodies"""
        if material is None:
            return Look("no material", base=(0.5,) * 3, specular=0.0)
        settings = material.lightwell
        thin = {"AUTO": not closed, "THIN": True, "SOLID": False}[settings.pane]
        look = self._tree_look(material, thin)
        look.luminance = settings.luminance or material.get("lw_luminance_cd_m2") or look.luminance
        look.transmittance = settings.transmittance or material.get("lw_transmittance") or look.transmittance
        return look

    def _tree_look(self, material, thin):
        if not (material.use_nodes and material.node_tree):
            return self._viewport_look(material, "has no nodes")
        output = next((n for n in material.node_tree.nodes if n.type == "OUTPUT_MATERIAL" and n.is_active_output), None)
        links = output.inputs["Surface"].links if output else ()
        if not links:
            return self._viewport_look(material, "has nothing at its output")
        look = self._shader_look(material, links[0].from_node, thin, 0)
        return look or self._viewport_look(material, f"has a {links[0].from_node.bl_label} shader, which is not read")

    def _viewport_look(self, material, reason):
        self.notes.append(f"material \"{material.name}\" {reason}: its viewport colour is taken as a dull paint")
        return Look(material.name, base=tuple(material.diffuse_color[:3]), roughness=1.0, specular=0.0)

    def _shader_look(self, material, node, thin, depth):
        read = {"BSDF_PRINCIPLED": self._principled, "BSDF_DIFFUSE": self._diffuse, "BSDF_GLOSSY": self._glossy,
                "BSDF_GLASS": self._glass, "BSDF_REFRACTION": self._glass, "BSDF_TRANSPARENT": self._transparent,
                "EMISSION": self._emission}.get(node.type)
        if read is not None:
            look = read(material, node)
            look.thin = thin
            return look
        if node.type == "MIX_SHADER" and depth < 8:
            return self._mix(material, node, thin, depth)
        return None

    def _principled(self, material, node):
        look = Look(material.name, metallic=self._value(node, "Metallic"), roughness=self._value(node, "Roughness"),
                    specular=self._named(node, "specular"), transmission=self._named(node, "transmission"),
                    index=self._value(node, "IOR"), emission=self._named(node, "emission"),
                    strength=self._named(node, "strength"))
        self._base(material, node, "Base Color", look)
        if look.metallic not in (0.0, 1.0) and look.metallic > 0.99:
            look.metallic = 1.0
        return look

    def _diffuse(self, material, node):
        look = Look(material.name, roughness=1.0, specular=0.0)
        self._base(material, node, "Color", look)
        return look

    def _glossy(self, material, node):
        look = Look(material.name, metallic=1.0, roughness=self._value(node, "Roughness"))
        self._base(material, node, "Color", look)
        return look

    def _glass(self, material, node):
        look = Look(material.name, transmission=1.0, index=self._value(node, "IOR"))
        self._base(material, node, "Color", look)
        return look

    def _transparent(self, material, node):
        look = Look(material.name, transmission=1.0, index=1.0001)
        self._base(material, node, "Color", look)
        return look

    def _emission(self, material, node):
        return Look(material.name, emission=self._value(node, "Color"), strength=self._value(node, "Strength"))

    def _mix(self, material, node, thin, depth):
        share = node.inputs[0].default_value
        if node.inputs[0].links:
            self.notes.append(f"material \"{material.name}\": the factor of a mix varies from place to place; "
                              f"{share:.2f} is taken everywhere")
        parts = []
        for part, socket in ((1 - share, node.inputs[1]), (share, node.inputs[2])):
            look = self._shader_look(material, socket.links[0].from_node, thin, depth + 1) if socket.links else None
            if look is None:
                return None
            parts.append((part, look))
        return Look(material.name, mixed=parts)

    def _base(self, material, node, socket, look):
        """The colour, or the picture that is linked to it."""
        look.base = self._value(node, socket)
        links = node.inputs[socket].links
        if not links:
            return
        source = links[0].from_node
        if source.type == "TEX_IMAGE" and source.image is not None:
            made = self._pictures.of(source.image, material.name)
            if made is not None:
                look.picture, look.picture_aspect = made
        elif source.type == "RGB":
            look.base = tuple(source.outputs[0].default_value[:3])
        else:
            self.notes.append(f"material \"{material.name}\": {source.bl_label} at {socket} is not read; "
                              f"the colour of the socket is taken")

    def _named(self, node, what):
        return next((self._value(node, name) for name in _SOCKETS[what] if name in node.inputs), 0.0)

    @staticmethod
    def _value(node, name):
        value = node.inputs[name].default_value
        return tuple(value[:3]) if hasattr(value, "__len__") else float(value)


class Pictures:
    """Images of Blender as files of the scene folder, each once."""

    def __init__(self, folder, notes):
        self._folder, self._notes, self._made = folder, notes, {}

    def of(self, image, material):
        """(file, width over height), or None with a note when the image has no pixels."""
        if image.name not in self._made:
            self._made[image.name] = self._make(image, material)
        return self._made[image.name]

    def _make(self, image, material):
        if not image.has_data:
            image.pixels  # makes Blender load the file
        width, height = image.size
        if width == 0 or height == 0:
            self._notes.append(f"material \"{material}\": image \"{image.name}\" is missing ({image.filepath}); "
                               "the colour of the socket is taken. Find it with File > External Data > Find Missing Files")
            return None
        suffix = {"PNG": ".png", "JPEG": ".jpg"}.get(image.file_format)
        packed = image.packed_file
        if suffix and packed is not None:
            data = bytes(packed.data)
        elif suffix and os.path.isfile(_path(image)):
            with open(_path(image), "rb") as file:
                data = file.read()
        else:
            data, suffix = _pixels(image), ".exr"
        return self._folder.texture(image.name, data, suffix), width / height


def _path(image):
    import bpy
    return bpy.path.abspath(image.filepath, library=image.library)


def _pixels(image):
    """Generated and float images, and formats the engine does not know, as OpenEXR in linear colours."""
    import numpy as np

    from .lightwell_bridge import exr
    width, height = image.size
    values = np.zeros(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(values)
    rows = values.reshape(height, width, image.channels)[::-1, :, :]
    rgb = rows[:, :, [min(c, image.channels - 1) for c in range(3)]]
    if not image.is_float and image.colorspace_settings.name == "sRGB":
        rgb = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return exr.to_bytes({name: rgb[:, :, i] for i, name in enumerate("RGB")})
