// Answers lines of standard input by the C# declarations, one line each; tests/unit/csharp/csharp_test.py compares the answers.
using System;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Runtime.InteropServices;
using System.Text;
using Semblante;

static unsafe class Answers {
    static string Number(double value) { return value.ToString("R", CultureInfo.InvariantCulture); }

    static double Number(string text) { return double.Parse(text, CultureInfo.InvariantCulture); }

    static string Words(Frame frame) {
        var words = new StringBuilder();
        words.Append(string.Join(" ", new[] { frame.Viseme1, frame.Viseme2, frame.VisemeBlend, frame.Expression1, frame.Intensity1,
                                              frame.Expression2, frame.Intensity2 }));
        for (int n = 3; n <= 68; ++n) words.Append(' ').Append(Number(frame.Fap[n]));
        return words.ToString();
    }

    static byte[] Bytes(string hex) {
        return Enumerable.Range(0, hex.Length / 2).Select(i => Convert.ToByte(hex.Substring(2 * i, 2), 16)).ToArray();
    }

    static Head head;
    static Performance performance;
    static Semblante.Stream stream;
    static Player player;

    static string Answer(string[] words) {
        Frame frame;
        switch (words[0]) {
            case "size":
                return Marshal.SizeOf(typeof(Semblante.Frame).Assembly.GetType(words[1], true)).ToString();
            case "head":
                head = new Head(File.ReadAllBytes(words[1] + "/mesh.drc"), File.ReadAllBytes(words[1] + "/weights"),
                                File.ReadAllBytes(words[1] + "/rig.json"), words.Length > 2);
                return head.VertexCount + " " + head.Triangles().Length;
            case "fap":
                frame = new Frame();
                frame.Fap[int.Parse(words[1])] = (float)Number(words[2]);
                head.SetFrame(frame);
                return string.Join(" ", head.Positions().Select(x => Number(x)));
            case "colors":
                return head.Colors() == null ? "none" : string.Join(" ", head.Colors());
            case "performance":
                performance = new Performance(File.ReadAllBytes(words[1]));
                return Number(performance.Duration);
            case "at":
                return Words(performance.FrameAt(Number(words[1])));
            case "arkit":
                var coefficients = new float[52];
                for (int i = 1; i < words.Length; i += 2) {
                    int shape = Enumerable.Range(0, 52).First(n => Bridges.ArkitName(n) == words[i]);
                    coefficients[shape] = (float)Number(words[i + 1]);
                }
                return Words(Bridges.FromArkit(coefficients));
            case "listen":
                var samples = new float[int.Parse(words[1])];
                for (int i = 0; i < samples.Length; ++i) samples[i] = i % 100 < 5 ? 0.25f : 0;
                Frame mouth;
                using (var listener = new Listener(16000)) return listener.Push(samples, out mouth) ? Words(mouth) : "nothing";
            case "stream":
                stream = new Semblante.Stream(captions: true);
                player = new Player(100);
                player.Follow(stream);
                stream.Start(0);
                stream.Opened(0);
                return BitConverter.ToString(stream.TakeBytes()).Replace("-", "").ToLowerInvariant();
            case "receive":
                stream.Receive(Bytes(words[2]), Number(words[1]));
                var happened = new StringBuilder();
                StreamEvent next;
                while (stream.NextEvent(out next)) {
                    happened.Append(next.Type).Append(' ');
                    if (next.Said != null)
                        happened.Append(next.Number + "|" + next.Language + "|" + next.Said + "|" + Number(next.Duration) + "|" +
                                        string.Join(",", next.WordTimes.Select(time => Number(time))) + " ");
                }
                return happened + stream.Frames().Length.ToString();
            case "frame":
                return Words(stream.Frames()[int.Parse(words[1])].Frame);
            case "play":
                return player.Advance(Number(words[1]), Number(words[2])) + " " + player.Show(head) + " " + Number(player.Time);
            case "wait":
                GC.Collect();
                GC.WaitForPendingFinalizers();
                return "done";
            default:
                return "unknown";
        }
    }

    static void Main() {
        string line;
        while ((line = Console.ReadLine()) != null) {
            string answer;
            try {
                answer = Answer(line.Split(' '));
            } catch (SemblanteException error) {
                answer = "error " + error.Code + " " + error.Where + " " + error.Message;
            }
            Console.WriteLine(answer);
        }
    }
}
