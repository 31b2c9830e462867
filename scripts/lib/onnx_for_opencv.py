"""Rewrites an ONNX network so that the dnn module of OpenCV 4.6 imports it.

The importer supports only static shapes, and neither computations with shapes, nor ReduceMean over the last axis, nor
broadcasting over 3D tensors. This module rewrites a network with one input for one fixed shape of that input. The
result is valid ONNX and computes the same up to rounding. Needs numpy and onnx (Debian: python3-onnx 1.12) alone.
"""

import numpy as np
import onnx
from onnx import helper, numpy_helper, shape_inference


class ConversionError(Exception):
    """The network has something that this module cannot rewrite; the message names the node."""


def convert(model, input_shape):
    """Rewrites the onnx.ModelProto in place for an input of this shape."""
    fix_input_shape(model, input_shape)
    drop_foreign_operator_sets(model)
    move_constants_to_initializers(model.graph)
    remove_identities(model.graph)
    fold_constants(model)
    write_in_operator_set_10(model)
    replace_means_of_last_axis(model)
    tile_constants_in_3d(model)
    remove_unused_initializers(model.graph)
    fix_output_shapes(model)


def output_shape(model):
    """The shape of the only output of a converted model."""
    (output,) = model.graph.output
    return dimensions(output)


# Access to the parts of a graph.


def dimensions(value):
    """The shape of a graph's value as a list; an unknown dimension is None, an unknown shape an empty list."""
    return [d.dim_value if d.HasField("dim_value") else None for d in value.type.tensor_type.shape.dim]


def set_dimensions(value, shape):
    tensor_type = value.type.tensor_type
    tensor_type.ClearField("shape")
    for size in shape:
        tensor_type.shape.dim.add().dim_value = size


def static_shapes(model):
    """The shapes that shape inference finds completely, by the name of the value."""
    graph = shape_inference.infer_shapes(model).graph
    shapes = {value.name: dimensions(value) for value in [*graph.input, *graph.value_info, *graph.output]}
    return {name: shape for name, shape in shapes.items() if shape and None not in shape}


def known_shape(shapes, node, name):
    if name not in shapes:
        raise ConversionError(f"node '{node.name}': the shape of '{name}' is not known; does the input's shape suit?")
    return shapes[name]


def constants(graph):
    """The values of all initializers by name."""
    return {tensor.name: numpy_helper.to_array(tensor) for tensor in graph.initializer}


def add_constant(graph, name, array):
    graph.initializer.append(numpy_helper.from_array(np.ascontiguousarray(array), name))


def attributes(node):
    return {attribute.name: helper.get_attribute_value(attribute) for attribute in node.attribute}


def keep_nodes(graph, nodes):
    nodes = list(nodes)
    del graph.node[:]
    graph.node.extend(nodes)


# The steps of the conversion.


def fix_input_shape(model, shape):
    graph = model.graph
    initialized = {tensor.name for tensor in graph.initializer}
    inputs = [value for value in graph.input if value.name not in initialized]
    if len(inputs) != 1:
        raise ConversionError(f"the network has {len(inputs)} inputs; only a network with one can be converted")
    del graph.input[:]
    graph.input.extend(inputs)
    set_dimensions(graph.input[0], shape)
    # The file's own shapes of intermediate values and outputs are dynamic; static_shapes infers static ones.
    del graph.value_info[:]
    for output in graph.output:
        output.type.tensor_type.ClearField("shape")


def drop_foreign_operator_sets(model):
    standard = [entry for entry in model.opset_import if entry.domain in ("", "ai.onnx")]
    del model.opset_import[:]
    model.opset_import.extend(standard)
    for node in model.graph.node:
        if node.domain not in ("", "ai.onnx"):
            raise ConversionError(f"node '{node.name}': operator {node.domain}.{node.op_type} is not a standard one")


def move_constants_to_initializers(graph):
    for node in graph.node:
        if node.op_type == "Constant":
            add_constant(graph, node.output[0], numpy_helper.to_array(attributes(node)["value"]))
    keep_nodes(graph, [node for node in graph.node if node.op_type != "Constant"])


def remove_identities(graph):
    outputs = {value.name for value in graph.output}
    source = {}
    kept = []
    for node in graph.node:
        for i, name in enumerate(node.input):
            node.input[i] = source.get(name, name)
        if node.op_type == "Identity" and node.output[0] not in outputs:
            source[node.output[0]] = node.input[0]
        else:
            kept.append(node)
    keep_nodes(graph, kept)


def fold_constants(model):
    """Replaces the computations with shapes by their results.

    Shape inference needs the shapes folded so far, and folding needs inferred shapes, so both alternate until no node
    is left to fold.
    """
    graph = model.graph
    values = constants(graph)
    while True:
        shapes = static_shapes(model)
        kept = []
        for node in graph.node:
            result = evaluate(node, values, shapes)
            if result is None:
                kept.append(node)
            else:
                values[node.output[0]] = result
                add_constant(graph, node.output[0], result)
        if len(kept) == len(graph.node):
            break
        keep_nodes(graph, kept)
    for node in graph.node:
        if node.op_type in ("Shape", "ConstantOfShape", "Range"):
            raise ConversionError(f"node '{node.name}': the result of {node.op_type} depends on the input")


def write_in_operator_set_10(model):
    """Lowers operator set 11 to 10, in which the bounds of Clip are attributes: OpenCV supports no other form.

    The only other operator in use that differs is Resize, whose nearest neighbour set 10 always takes at the floor.
    """
    (operator_set,) = model.opset_import
    if operator_set.version > 11:
        raise ConversionError(f"operator set {operator_set.version} is not supported, only 11 and older ones")
    values = constants(model.graph)
    for node in model.graph.node:
        if node.op_type == "Clip" and len(node.input) > 1:
            bounds = zip(("min", "max"), list(node.input)[1:])
            node.attribute.extend(helper.make_attribute(key, float(values[name])) for key, name in bounds if name)
            del node.input[1:]
        elif node.op_type == "Resize" and len(node.input) > 2:
            resize = rewritten_resize(node)
            node.CopyFrom(resize)
    operator_set.version = min(operator_set.version, 10)


def rewritten_resize(node):
    options = attributes(node)
    way = [options.get(key) for key in ("mode", "coordinate_transformation_mode", "nearest_mode")]
    if way != [b"nearest", b"asymmetric", b"floor"] or len(node.input) != 3:
        raise ConversionError(f"node '{node.name}': only Resize by scales with nearest_mode floor is supported")
    image, _, scales = node.input
    return helper.make_node("Resize", [image, scales], list(node.output), node.name, mode="nearest")


def replace_means_of_last_axis(model):
    """Replaces ReduceMean over the last axis of size n by a product with the n x n matrix whose elements are 1/n.

    The result has the shape of the operand, so the subtraction or division that follows needs no broadcasting.
    """
    shapes = static_shapes(model)
    matrices = set()
    for node in model.graph.node:
        if node.op_type != "ReduceMean":
            continue
        shape, options = known_shape(shapes, node, node.input[0]), attributes(node)
        if options.get("axes") not in ([-1], [len(shape) - 1]) or not options.get("keepdims", 1):
            raise ConversionError(f"node '{node.name}': only ReduceMean over the last axis with keepdims is supported")
        size = shape[-1]
        name = f"mean_of_{size}"
        if name not in matrices:
            matrices.add(name)
            add_constant(model.graph, name, np.full((size, size), 1 / size, np.float32))
        node.CopyFrom(helper.make_node("MatMul", [node.input[0], name], list(node.output), node.name))


def tile_constants_in_3d(model):
    """Gives a constant operand of an operation with a 3D result the shape of that result, unless it is one number."""
    shapes = static_shapes(model)
    values = constants(model.graph)
    for node in model.graph.node:
        if node.op_type not in ("Add", "Sub", "Mul", "Div"):
            continue
        shape = known_shape(shapes, node, node.output[0])
        for i, name in enumerate(node.input):
            if len(shape) == 3 and name in values and values[name].size > 1 and list(values[name].shape) != shape:
                node.input[i] = f"{node.output[0]}.operand{i}"
                add_constant(model.graph, node.input[i], np.broadcast_to(values[name], shape))


def remove_unused_initializers(graph):
    used = {name for node in graph.node for name in node.input} | {value.name for value in graph.output}
    kept = [tensor for tensor in graph.initializer if tensor.name in used]
    del graph.initializer[:]
    graph.initializer.extend(kept)


def fix_output_shapes(model):
    shapes = static_shapes(model)
    for output in model.graph.output:
        if output.name not in shapes:
            raise ConversionError(f"output '{output.name}': its shape depends on the input's values")
        set_dimensions(output, shapes[output.name])


# The evaluation of single nodes.


def evaluate(node, values, shapes):
    """The result of a node whose operands are constants, or of Shape if that shape is known; otherwise None.

    Only operators that occur in computations with shapes are evaluated.
    """
    if node.op_type == "Shape":
        shape = shapes.get(node.input[0])
        return None if shape is None else np.array(shape, np.int64)
    evaluator = EVALUATORS.get(node.op_type)
    operands = [values.get(name) for name in node.input if name]
    if evaluator is None or any(operand is None for operand in operands):
        return None
    return np.asarray(evaluator(attributes(node), *operands))


def evaluate_slice(options, data, starts=None, ends=None, axes=None, steps=None):
    """Bounds are attributes up to operator set 9 and operands since."""
    starts = options.get("starts", starts)
    ends = options.get("ends", ends)
    axes = options.get("axes", range(len(starts)) if axes is None else axes)
    steps = np.ones(len(starts), np.int64) if steps is None else steps
    index = [slice(None)] * data.ndim
    for axis, start, end, step in zip(axes, starts, ends, steps):
        # With a negative step, an end below -size means that the first element is included.
        reaches_first = step < 0 and end < -data.shape[axis]
        index[axis] = slice(int(start), None if reaches_first else int(end), int(step))
    return data[tuple(index)]


def evaluate_cast(options, data):
    return data.astype(onnx.mapping.TENSOR_TYPE_TO_NP_TYPE[options["to"]])


def evaluate_constant_of_shape(options, shape):
    value = numpy_helper.to_array(options["value"]) if "value" in options else np.zeros(1, np.float32)
    return np.full([int(size) for size in shape], value[0])


EVALUATORS = {
    "Cast": evaluate_cast,
    "Concat": lambda options, *parts: np.concatenate(parts, options["axis"]),
    "ConstantOfShape": evaluate_constant_of_shape,
    "Gather": lambda options, data, indices: np.take(data, indices, options.get("axis", 0)),
    "Range": lambda options, start, limit, step: np.arange(start, limit, step),
    "Slice": evaluate_slice,
    "Squeeze": lambda options, data: np.squeeze(data, tuple(options["axes"]) if "axes" in options else None),
    "Unsqueeze": lambda options, data: np.expand_dims(data, tuple(options["axes"])),
}
