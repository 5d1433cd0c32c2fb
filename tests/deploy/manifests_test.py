"""deploy/compose and deploy/kubernetes: read by the tools of their systems where installed, and checked against the server.

Needs PyYAML; kubectl, docker-compose and caddy are used where they are installed."""

import json
import re
import shutil
import unittest

import support
from support import PROGRAM, TOP, run

try:
    import yaml
except ImportError:
    yaml = None

KUBERNETES = TOP / "deploy/kubernetes"
COMPOSE = TOP / "deploy/compose/compose.yaml"
CONTAINERFILE = (TOP / "deploy/image/Containerfile").read_text()
ACCOUNT = re.search(r"^USER (\d+):(\d+)$", CONTAINERFILE, re.MULTILINE).groups()
STOP_SECONDS = int(re.search(r"^TimeoutStopSec=(\d+)$", (TOP / "deploy/package/semblante.service.in").read_text(), re.MULTILINE).group(1))


def labels(thing):
    return thing["metadata"].get("labels", {})


def rendered():
    """The documents of the kustomization: by kubectl, or put together here as far as the checks need it."""
    if shutil.which("kubectl"):
        result = run("kubectl", "kustomize", KUBERNETES)
        assert result.returncode == 0, result.stderr
        return list(yaml.safe_load_all(result.stdout))
    recipe = yaml.safe_load((KUBERNETES / "kustomization.yaml").read_text())
    documents = [document for name in recipe["resources"] for document in yaml.safe_load_all((KUBERNETES / name).read_text())]
    common = recipe["labels"][0]["pairs"]
    for document in documents:
        spec = document.get("spec", {})
        if document["kind"] == "StatefulSet":
            spec["selector"] = {"matchLabels": common}
            spec["template"]["metadata"] = {"labels": common}
            for container in spec["template"]["spec"]["containers"]:
                for image in recipe["images"]:
                    if container["image"] == image["name"]:
                        container["image"] += f":{image['newTag']}"
        elif document["kind"] == "Service":
            spec["selector"] = common
        elif document["kind"] == "NetworkPolicy":
            spec["podSelector"] = {"matchLabels": common}
        document["metadata"]["namespace"] = recipe["namespace"]
    for generated in recipe["configMapGenerator"]:
        data = dict(literal.split("=", 1) for literal in generated.get("literals", []))
        data.update({name: (KUBERNETES / name).read_text() for name in generated.get("files", [])})
        documents.append({"kind": "ConfigMap", "metadata": {"name": generated["name"], "namespace": recipe["namespace"]}, "data": data})
    return documents


@unittest.skipIf(yaml is None, "PyYAML is not installed (python3-yaml)")
class Manifests(unittest.TestCase):
    def check_environment(self, values):
        """The server takes these variables: each sets an option, to a value that is valid."""
        result = run(PROGRAM, "serve", "--print-config", environment=support.clean_environment(**values))
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in values:
            self.assertIn(f"  # environment {name}\n", result.stdout, f"{name} is no variable of semblante serve")

    def check_caddyfile(self, text):
        if shutil.which("caddy"):
            with support.temporary_folder() as folder:
                (folder / "Caddyfile").write_text(text)
                result = run("caddy", "adapt", "--adapter", "caddyfile", "--config", folder / "Caddyfile", "--validate",
                             environment=support.clean_environment(HOME=folder))
                self.assertEqual(result.returncode, 0, result.stderr)
                return json.loads(result.stdout)
        return None

    def check_version(self, image):
        name, tag = image.rsplit(":", 1)
        if name == "semblante":
            self.assertEqual(tag, re.search(r"project\(semblante VERSION (\S+)", (TOP / "CMakeLists.txt").read_text()).group(1))
        self.assertRegex(tag, r"^\d", "an image with a version")

    def one(self, documents, kind):
        found = [document for document in documents if document["kind"] == kind]
        self.assertEqual(len(found), 1, kind)
        return found[0]

    def test_kubernetes(self):
        documents = rendered()
        for document in documents:
            if document["kind"] != "Namespace":
                self.assertEqual(document["metadata"]["namespace"], "semblante")
        maps = {document["metadata"]["name"]: document["data"] for document in documents if document["kind"] == "ConfigMap"}
        workload = self.one(documents, "StatefulSet")["spec"]
        self.assertEqual(workload["replicas"], 1, "one server in a data folder")
        pod = workload["template"]["spec"]
        pod_labels = workload["template"]["metadata"]["labels"]
        self.assertGreaterEqual(pod_labels.items(), workload["selector"]["matchLabels"].items())
        self.assertGreaterEqual(pod["terminationGracePeriodSeconds"], STOP_SECONDS)
        self.assertEqual((pod["securityContext"]["runAsUser"], pod["securityContext"]["fsGroup"]), tuple(map(int, ACCOUNT)))
        self.assertTrue(pod["securityContext"]["runAsNonRoot"])
        self.assertEqual(pod["securityContext"]["seccompProfile"], {"type": "RuntimeDefault"})
        volumes = {volume["name"] for volume in pod["volumes"]} | {claim["metadata"]["name"] for claim in workload["volumeClaimTemplates"]}
        ports = {}
        for container in pod["containers"]:
            context = container["securityContext"]
            self.assertFalse(context["allowPrivilegeEscalation"])
            self.assertTrue(context["readOnlyRootFilesystem"])
            self.assertEqual(context["capabilities"]["drop"], ["ALL"])
            self.assertIn("memory", container["resources"]["limits"])
            self.check_version(container["image"])
            for mount in container["volumeMounts"]:
                self.assertIn(mount["name"], volumes)
            ports.update({port["name"]: port["containerPort"] for port in container.get("ports", [])})
        for volume in pod["volumes"]:
            if "configMap" in volume:
                self.assertIn(volume["configMap"]["name"], maps)

        server, proxy = pod["containers"]
        settings = maps[server["envFrom"][0]["configMapRef"]["name"]]
        self.check_environment(settings)
        self.assertIn({"name": "data", "mountPath": re.search(r"SEMBLANTE_DATA=(\S+)", CONTAINERFILE).group(1)}, server["volumeMounts"])
        for probe in ("startupProbe", "readinessProbe", "livenessProbe"):
            command = server[probe]["exec"]["command"]
            self.assertEqual(command[0], "/usr/bin/semblante")
            # Nobody listens: the command is understood, and says so.
            self.assertEqual(run(PROGRAM, *command[1:], environment=support.clean_environment(SEMBLANTE_PORT=1)).returncode, 1, command)

        caddyfile = next(data["Caddyfile"] for data in maps.values() if "Caddyfile" in data)
        self.assertIn(f"reverse_proxy 127.0.0.1:{settings['SEMBLANTE_PORT']} ", caddyfile)
        self.assertIn(f"\n:{ports['http']} {{", caddyfile)
        self.check_caddyfile(caddyfile)

        service = self.one(documents, "Service")
        self.assertGreaterEqual(pod_labels.items(), service["spec"]["selector"].items())
        port = service["spec"]["ports"][0]
        self.assertIn(port["targetPort"], ports)
        rule = self.one(documents, "Ingress")["spec"]["rules"][0]
        backend = rule["http"]["paths"][0]["backend"]["service"]
        self.assertEqual((backend["name"], backend["port"]["name"]), (service["metadata"]["name"], port["name"]))
        self.assertEqual(rule["host"], settings["SEMBLANTE_ALLOW_HOST"])
        policy = self.one(documents, "NetworkPolicy")["spec"]
        self.assertGreaterEqual(pod_labels.items(), policy["podSelector"].get("matchLabels", {}).items())
        self.assertIn(policy["ingress"][0]["ports"][0]["port"], ports)
        self.assertEqual(self.one(documents, "Namespace")["metadata"]["labels"]["pod-security.kubernetes.io/enforce"], "restricted")

    def test_every_file_belongs_to_the_kustomization(self):
        text = (KUBERNETES / "kustomization.yaml").read_text()
        self.assertEqual([path.name for path in KUBERNETES.iterdir() if path.name != "kustomization.yaml" and path.name not in text], [])

    def test_compose(self):
        if shutil.which("docker-compose"):
            result = run("docker-compose", "-f", COMPOSE, "config")
            self.assertEqual(result.returncode, 0, result.stderr)
        text = COMPOSE.read_text().replace("${SEMBLANTE_SITE:-faces.example}", "faces.example")
        services = yaml.safe_load(text)["services"]
        for service in services.values():
            self.assertEqual(service["cap_drop"], ["ALL"])
            self.assertIn("no-new-privileges:true", service["security_opt"])
            self.check_version(service["image"])
        server = services["semblante"]
        self.check_environment(server["environment"])
        self.assertEqual(server["user"], ":".join(ACCOUNT))
        self.assertTrue(server["read_only"])
        self.assertNotIn("ports", server)
        self.assertEqual(server["network_mode"], "service:caddy")
        self.assertGreaterEqual(int(server["stop_grace_period"].rstrip("s")), STOP_SECONDS)
        source = services["caddy"]["volumes"][0].split(":")[0]
        self.check_caddyfile((COMPOSE.parent / source).resolve(strict=True).read_text())

    def test_faulty_settings_are_noticed(self):
        with self.assertRaises(AssertionError):
            self.check_environment({"SEMBLANTE_PROT": "1"})
        with self.assertRaises(AssertionError):
            self.check_environment({"SEMBLANTE_PORT": "x"})


support.main()
