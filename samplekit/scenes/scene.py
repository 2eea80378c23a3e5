from samplekit.integration.scene import Scene as Scene
