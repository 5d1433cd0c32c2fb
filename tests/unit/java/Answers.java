import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Paths;
import semblante.Bridges;
import semblante.Frame;
import semblante.Head;
import semblante.Listener;
import semblante.Performance;
import semblante.Player;
import semblante.SemblanteException;
import semblante.Stream;
import semblante.StreamEvent;

/** Answers lines of standard input by the Java classes, one line each; java_test.py compares the answers. */
final class Answers {
    private Head head;
    private Performance performance;
    private Stream stream;
    private Player player;

    private static byte[] read(String path) throws IOException {
        return Files.readAllBytes(Paths.get(path));
    }

    private static String words(Frame frame) {
        StringBuilder words = new StringBuilder();
        for (int value : frame.highLevel()) words.append(value).append(' ');
        for (int fap = 3; fap <= 68; ++fap) words.append(frame.fap(fap)).append(' ');
        return words.toString().trim();
    }

    private static byte[] bytes(String hex) {
        byte[] bytes = new byte[hex.length() / 2];
        for (int i = 0; i < bytes.length; ++i) bytes[i] = (byte) Integer.parseInt(hex.substring(2 * i, 2 * i + 2), 16);
        return bytes;
    }

    private static String named(Enum<?> value) {
        return value.name().charAt(0) + value.name().substring(1).toLowerCase(java.util.Locale.ROOT);
    }

    private static String truth(boolean value) {
        return value ? "True" : "False";
    }

    /** JNI ends the process for an array that is null; the classes do not. */
    private String nulls() {
        Runnable[] calls = {
            () -> new Head(null, new byte[1], new byte[1]),
            () -> new Head(new byte[1], null, new byte[1]),
            () -> new Head(new byte[1], new byte[1], null),
            () -> head.positions(null),
            () -> head.normals(null, new float[3]),
            () -> head.normals(new float[3], null),
            () -> new Stream().receive(null, 0),
            () -> new Stream(true, false, 0, true).publishSound(null, 1),
            () -> new Performance(null),
            () -> new Listener(16000).push(null),
            () -> Bridges.fromArkit(null),
            () -> head.setFrame(null),
        };
        int refused = 0;
        for (Runnable call : calls) {
            try {
                call.run();
            } catch (NullPointerException error) {
                ++refused;
            }
        }
        return refused + " of " + calls.length;
    }

    private String answer(String[] words) throws IOException {
        switch (words[0]) {
            case "head":
                if (head != null) head.close();
                head = new Head(read(words[1] + "/mesh.drc"), read(words[1] + "/weights"), read(words[1] + "/rig.json"),
                        words.length > 2);
                return head.vertexCount + " " + head.triangles().length;
            case "fap":
                head.setFrame(new Frame().setFap(Integer.parseInt(words[1]), Float.parseFloat(words[2])));
                float[] positions = new float[3 * head.vertexCount];
                head.positions(positions);
                StringBuilder coordinates = new StringBuilder();
                for (float x : positions) coordinates.append((double) x).append(' ');
                return coordinates.toString().trim();
            case "colors":
                if (head.colors() == null) return "none";
                StringBuilder channels = new StringBuilder();
                for (byte channel : head.colors()) channels.append(channel & 0xff).append(' ');
                return channels.toString().trim();
            case "normals":
                float[] at = new float[3 * head.vertexCount];
                float[] normals = new float[at.length];
                head.positions(at);
                head.normals(at, normals);
                double longest = 0;
                for (int i = 0; i < normals.length; i += 3)
                    longest = Math.max(longest, Math.hypot(Math.hypot(normals[i], normals[i + 1]), normals[i + 2]));
                return String.valueOf(longest);
            case "null":
                return nulls();
            case "short":
                head.positions(new float[3]);
                return "taken";
            case "performance":
                performance = new Performance(read(words[1]));
                return String.valueOf(performance.duration());
            case "at":
                return words(performance.frameAt(Double.parseDouble(words[1])));
            case "arkit":
                float[] coefficients = new float[52];
                for (int i = 1; i < words.length; i += 2)
                    for (int shape = 0; shape < 52; ++shape)
                        if (Bridges.arkitName(shape).equals(words[i])) coefficients[shape] = Float.parseFloat(words[i + 1]);
                return words(Bridges.fromArkit(coefficients));
            case "listen":
                float[] samples = new float[Integer.parseInt(words[1])];
                for (int i = 0; i < samples.length; ++i) samples[i] = i % 100 < 5 ? 0.25f : 0;
                Listener listener = new Listener(16000);
                Frame mouth = listener.push(samples);
                listener.close();
                return mouth == null ? "nothing" : words(mouth);
            case "stream":
                stream = new Stream();
                stream.setCaptions(true);
                player = new Player(100, false);
                player.follow(stream);
                stream.start(0);
                stream.opened(0);
                StringBuilder hello = new StringBuilder();
                for (byte b : stream.takeBytes()) hello.append(String.format("%02x", b));
                return hello.toString();
            case "receive":
                stream.receive(bytes(words[2]), Double.parseDouble(words[1]));
                StringBuilder happened = new StringBuilder();
                for (StreamEvent next = stream.nextEvent(); next != null; next = stream.nextEvent()) {
                    happened.append(named(next.type)).append(' ');
                    if (next.said == null) continue;
                    happened.append(next.number + "|" + next.language + "|" + next.said + "|" + (int) next.duration + "|");
                    for (int i = 0; i < next.wordTimes.length; ++i) happened.append(i > 0 ? "," : "").append((int) next.wordTimes[i]);
                    happened.append(' ');
                }
                return happened.toString() + stream.frames().length;
            case "play":
                boolean shows = player.advance(Double.parseDouble(words[1]), Double.parseDouble(words[2]));
                return truth(shows) + " " + truth(player.show(head)) + " " + player.time();
            case "wait":
                System.gc();
                return "done";
            default:
                return "unknown";
        }
    }

    public static void main(String[] args) throws IOException {
        Answers answers = new Answers();
        BufferedReader in = new BufferedReader(new InputStreamReader(System.in, StandardCharsets.UTF_8));
        PrintStream out = new PrintStream(System.out, true, "UTF-8");
        for (String line = in.readLine(); line != null; line = in.readLine()) {
            try {
                out.println(answers.answer(line.split(" ")));
            } catch (SemblanteException error) {
                out.println("error " + error.code + " " + error.where + " " + error.getMessage());
            }
        }
    }
}
