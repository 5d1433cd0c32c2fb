# A face that follows a stream: the bytes of a WebSocket to libsemblante, its vertices to a mesh.
extends MeshInstance

# A stream, and a folder or server address with the parts of a face package.
export var stream_url := "ws://127.0.0.1:8080/v1/streams/demo"
export var package := "res://package"

enum {START, OPENED, CLOSED, PASSES}
enum {NOTHING, STATE, CONNECT, CLOSE}

var native := GDNative.new()
var socket: WebSocketClient = null
var triangles := PoolIntArray()
var positions := PoolVector3Array()
var colors := PoolColorArray()
# Display frames in which the face had a new pose.
var shown := 0


func run(function: String, arguments := []):
	return native.call_native("standard_varcall", function, arguments)


func read(name: String) -> PoolByteArray:
	var file := File.new()
	if file.open(package + "/" + name, File.READ) != OK:
		push_error("cannot read " + package + "/" + name)
		return PoolByteArray()
	return file.get_buffer(file.get_len())


func now() -> float:
	return OS.get_ticks_usec() / 1000.0


func _ready() -> void:
	native.library = load("res://semblante.gdnlib")
	if not native.initialize():
		push_error("the library was not loaded")
		return
	var vertices: int = run("face_load", [read("mesh.drc"), read("weights"), read("rig.json")])
	if vertices <= 0:
		push_error("the package was refused: result %d" % -vertices)
		return
	triangles = run("face_triangles")
	colors = run("face_colors")
	if colors.size() > 0:
		material_override = colored_material()
	mesh = ArrayMesh.new()
	show_positions()
	run("stream_tell", [START, now()])


func _exit_tree() -> void:
	native.terminate()


func connect_socket() -> void:
	socket = WebSocketClient.new()
	socket.connect("connection_established", self, "_opened")
	socket.connect("connection_error", self, "_closed")
	socket.connect("connection_closed", self, "_closed")
	socket.connect("data_received", self, "_received")
	if socket.connect_to_url(stream_url, PoolStringArray(["semblante.v1"])) != OK:
		_closed()


func _opened(_protocol: String) -> void:
	socket.get_peer(1).set_write_mode(WebSocketPeer.WRITE_MODE_BINARY)
	run("stream_tell", [OPENED, now()])


func _closed(_was_clean := false) -> void:
	socket = null
	run("stream_tell", [CLOSED, now()])


func _received() -> void:
	run("stream_receive", [socket.get_peer(1).get_packet(), now()])


func _process(delta: float) -> void:
	if triangles.size() == 0:
		return
	if socket != null:
		socket.poll()
	run("stream_tell", [PASSES, now()])
	var event: int = run("stream_event")
	while event != NOTHING:
		if event == CONNECT:
			connect_socket()
		elif event == CLOSE and socket != null:
			socket.disconnect_from_host()
			socket = null
		event = run("stream_event")
	var message: PoolByteArray = run("stream_take")
	while message.size() > 0:
		if socket != null:
			socket.get_peer(1).put_packet(message)
		message = run("stream_take")
	if run("face_show", [now(), delta * 1000.0]) == 1:
		show_positions()
		shown += 1


func colored_material() -> SpatialMaterial:
	var colored := SpatialMaterial.new()
	colored.vertex_color_use_as_albedo = true
	colored.vertex_color_is_srgb = true
	return colored


func show_positions() -> void:
	positions = run("face_positions")
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = positions
	arrays[Mesh.ARRAY_INDEX] = triangles
	if colors.size() > 0:
		arrays[Mesh.ARRAY_COLOR] = colors
	if mesh.get_surface_count() > 0:
		mesh.surface_remove(0)
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
