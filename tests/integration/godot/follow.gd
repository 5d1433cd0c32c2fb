# Runs face.gd without a window until the face had 30 new poses, and tells what moved.
extends SceneTree

var face: Node
var first := PoolVector3Array()
var began := 0


func _initialize() -> void:
	face = load("res://face.gd").new()
	face.stream_url = OS.get_environment("SEMBLANTE_STREAM")
	root.add_child(face)
	first = face.positions
	began = OS.get_ticks_msec()


func _idle(_delta: float) -> bool:
	var patience := int(OS.get_environment("SEMBLANTE_PATIENCE")) * 1000
	if face.shown < 30 and OS.get_ticks_msec() - began < patience and first.size() > 0:
		return false
	var moved := 0
	for i in first.size():
		if first[i] != face.positions[i]:
			moved += 1
	# What the engine would draw.
	var drawn: PoolColorArray = face.mesh.surface_get_arrays(0)[Mesh.ARRAY_COLOR]
	var reddest := Color(0, 0, 0)
	for color in drawn:
		if color.r > reddest.r:
			reddest = color
	print("vertices ", first.size(), " corners ", face.triangles.size(), " shown ", face.shown, " moved ", moved, " colors ", drawn.size(),
			" reddest ", reddest)
	quit()
	return true
