# Renders a scene of write_cycles.cpp with Cycles on processors:
#   blender -b -noaudio --debug-cycles --verbose 1 -P cycles.py -- SCENE.json SAMPLES SEED THREADS OUT.exr
# Prints RENDER_SECONDS, of the call that renders: with the building of Cycles' own scene, without Blender's start.
# Cycles is left to be a path tracer: no denoising, no adaptive sampling, no clamping, no blurring of glossy
# paths, all caustics. What it knows of light sampling and roulette stays as it comes.
import json, os, sys, time
import bpy
import numpy as np
from mathutils import Matrix

file, samples, seed, threads, out = sys.argv[sys.argv.index('--') + 1:]
folder = os.path.dirname(os.path.abspath(file))
scene = json.load(open(file))


def array(where, kind, columns):
    offset, count = where
    if count == 0:
        return np.empty((0, columns), kind)
    return np.fromfile(os.path.join(folder, 'scene.bin'), kind, count, offset=offset).reshape(-1, columns)


bpy.ops.wm.read_factory_settings(use_empty=True)
S = bpy.context.scene


def picture(name, nearest, colors):
    image = bpy.data.images.load(os.path.join(folder, name))
    image.colorspace_settings.name = colors
    return image, 'Closest' if nearest else 'Linear'


pictures = [picture(p['file'], p['nearest'], 'sRGB') for p in scene.get('pictures', [])]


def material(surface, emission, two_sided):
    made = bpy.data.materials.new('m')
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    new, link = tree.nodes.new, tree.links.new
    rgb = (*surface['rgb'], 1)
    if surface['kind'] == 'diffuse':
        node = new('ShaderNodeBsdfDiffuse')
        node.inputs['Color'].default_value = rgb
        if surface['picture'] >= 0:
            texture = new('ShaderNodeTexImage')
            texture.image, texture.interpolation = pictures[surface['picture']]
            link(texture.outputs['Color'], node.inputs['Color'])
    else:
        node = new('ShaderNodeBsdfGlass' if surface['kind'] == 'glass' else 'ShaderNodeBsdfGlossy')
        node.distribution = 'SHARP' if bpy.app.version < (4, 0, 0) else 'GGX'  # from 4.0 on, roughness 0 is sharp
        node.inputs['Roughness'].default_value = 0
        node.inputs['Color'].default_value = rgb
        if surface['kind'] == 'glass':
            node.inputs['IOR'].default_value = surface['index']
    shader = node.outputs[0]
    if any(emission):
        light = new('ShaderNodeEmission')
        light.inputs['Color'].default_value = (*emission, 1)
        light.inputs['Strength'].default_value = 1
        if not two_sided:  # 1 - backfacing
            side, front = new('ShaderNodeNewGeometry'), new('ShaderNodeMath')
            front.operation = 'SUBTRACT'
            front.inputs[0].default_value = 1
            link(side.outputs['Backfacing'], front.inputs[1])
            link(front.outputs[0], light.inputs['Strength'])
        both = new('ShaderNodeAddShader')
        link(shader, both.inputs[0])
        link(light.outputs[0], both.inputs[1])
        shader = both.outputs[0] if any(surface['rgb']) else light.outputs[0]
    link(shader, new('ShaderNodeOutputMaterial').inputs['Surface'])
    return made


def add_mesh(mesh):
    p, n = array(mesh['p'], '<f4', 3), array(mesh['n'], '<f4', 3)
    uv, corners = array(mesh['uv'], '<f4', 2), array(mesh['triangles'], '<i4', 3).ravel()
    count = len(corners) // 3
    made = bpy.data.meshes.new('mesh')
    made.vertices.add(len(p))
    made.vertices.foreach_set('co', p.ravel())
    made.loops.add(len(corners))
    made.loops.foreach_set('vertex_index', corners)
    made.polygons.add(count)
    made.polygons.foreach_set('loop_start', np.arange(0, 3 * count, 3, dtype=np.int32))
    if bpy.app.version < (4, 0, 0):
        made.polygons.foreach_set('loop_total', np.full(count, 3, np.int32))
    made.polygons.foreach_set('use_smooth', np.full(count, len(n) > 0))
    if len(uv):
        made.uv_layers.new().data.foreach_set('uv', uv[corners].ravel())
    made.update(calc_edges=True)
    if len(n):
        if hasattr(made, 'use_auto_smooth'):
            made.use_auto_smooth = True
        made.normals_split_custom_set_from_vertices(n.tolist())
    made.materials.append(material(scene['surfaces'][mesh['surface']], mesh['emission'], mesh['two_sided']))
    S.collection.objects.link(bpy.data.objects.new('mesh', made))


for mesh in scene['meshes']:
    add_mesh(mesh)

S.world = bpy.data.worlds.new('sky')
S.world.use_nodes = True
tree = S.world.node_tree
background = tree.nodes['Background']
background.inputs['Color'].default_value = (*scene['sky'], 1)
background.inputs['Strength'].default_value = 1
if 'sky_picture' in scene:
    sky = tree.nodes.new('ShaderNodeTexEnvironment')
    sky.image = picture(scene['sky_picture'], False, 'Linear' if bpy.app.version < (4, 0, 0) else 'Linear Rec.709')[0]
    tree.links.new(sky.outputs['Color'], background.inputs['Color'])

C = scene['camera']
camera = bpy.data.cameras.new('camera')
width, height = scene['resolution']
camera.sensor_fit = 'VERTICAL' if width >= height else 'HORIZONTAL'
if width >= height:
    camera.sensor_height = camera.sensor_width
camera.angle = C['fov']  # of the side that the sensor is fitted to
camera.clip_start, camera.clip_end = 1e-4, 1e6
placed = bpy.data.objects.new('camera', camera)
S.collection.objects.link(placed)
S.camera = placed
placed.matrix_world = Matrix([(*row, 1 if i == 3 else 0) for i, row in enumerate(
    [C['right'], C['up'], [-x for x in C['forward']], C['eye']])]).transposed()

R, cycles = S.render, S.cycles
R.engine = 'CYCLES'
R.resolution_x, R.resolution_y, R.resolution_percentage = width, height, 100
R.threads_mode, R.threads = 'FIXED', int(threads)
cycles.device = 'CPU'
cycles.samples, cycles.seed = int(samples), int(seed)
cycles.use_denoising = cycles.use_adaptive_sampling = False
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
cycles.caustics_reflective = cycles.caustics_refractive = True
for limit in ['max_bounces', 'diffuse_bounces', 'glossy_bounces', 'transmission_bounces', 'transparent_max_bounces']:
    setattr(cycles, limit, scene['bounces'])
cycles.pixel_filter_type = 'BOX'
S.view_settings.view_transform = 'Standard'
R.image_settings.file_format, R.image_settings.color_mode = 'OPEN_EXR', 'RGB'
R.image_settings.color_depth = '32'
R.filepath = out
start = time.time()
bpy.ops.render.render(write_still=True)
print('RENDER_SECONDS %.3f' % (time.time() - start), flush=True)
