"""live_connections.py BRECCIA SCRATCH COUNT: ParaViews that connect to a run at rest, take its surface and are killed, one after the other.

The run must go on with as many descriptors, and without more memory than half of them have left it with. Prints both at some of them.
This script starts itself in pvpython, which forks a ParaView for each connection: to start COUNT of them would take an hour."""
import os
import signal
import socket
import subprocess
import sys
import time

PATIENCE = 120.0  # s, for a connection
GROWTH = 0.01     # asked for: flat to 1 %, once half of the connections have been made
CASE = """
title = "A block of 19,200 elements at rest"
[mesh.raster]
cells = [20, 20, 2]
cell_size = "1 cm"
group = "block"
[[material]]
group = "block"
young = "26.6 GPa"
poisson = 0.205
density = "2340 kg/m3"
joints = "none"
[[stage]]
name = "rest"
end = "100 s"
[output]
frame_interval = "10 s"
history_interval = "1 s"
[insitu]
[insitu.live]
address = "localhost:%d"
channels = ["surface"]
interval = 0.01
max_overhead = 1.0
"""


def watch(port, count, heard):
    """In pvpython: writes a line for each connection that has received the surface, to the descriptor `heard`."""
    from paraview import live

    def one():
        link = live.ConnectToCatalyst("localhost", port)
        proxies = link.GetInsituProxyManager
        end = time.time() + PATIENCE

        def wait(condition):
            while not condition():
                if time.time() > end:
                    os._exit(1)
                live.ProcessServerNotifications()
                time.sleep(0.005)
        wait(lambda: proxies() and proxies().GetNumberOfProxies("sources") >= 1)
        surface = live.ExtractCatalystData(link, "surface")

        def cells():
            surface.UpdatePipeline()
            return surface.GetDataInformation().GetNumberOfCells()
        wait(lambda: cells() > 0)
        os.write(heard, b"%d\n" % cells())
        os.kill(os.getpid(), signal.SIGKILL)

    for _ in range(count):
        child = os.fork()
        if child == 0:
            one()
        if os.waitpid(child, 0)[1] != signal.SIGKILL:
            os._exit(1)
    os._exit(0)


def free_port():
    """One that is free, with the next one, which ParaView takes for data."""
    for port in range(23000 + os.getpid() % 5000, 32000, 7):
        listeners = [socket.socket(), socket.socket()]
        try:
            for i, listener in enumerate(listeners):
                listener.bind(("127.0.0.1", port + i))
            return port
        except OSError:
            continue
        finally:
            for listener in listeners:
                listener.close()
    sys.exit("FAILED: no free port")


def resident_mb(process):
    with open(f"/proc/{process}/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE") / 1e6


def main(breccia, scratch, count):
    port = free_port()
    os.makedirs(scratch, exist_ok=True)
    with open(f"{scratch}/case.toml", "w") as file:
        file.write(CASE % port)
    messages = open(f"{scratch}/run.log", "w")
    run = subprocess.Popen([breccia, "run", f"{scratch}/case.toml", "-f", "-o", f"{scratch}/run", "--progress", "none"], stdout=messages,
                           stderr=messages)
    ready, heard = os.pipe()
    plain = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_COMM", "PMIX", "DISPLAY"))}
    client = subprocess.Popen(["pvpython", os.path.abspath(__file__), "--watch", str(port), str(count), str(heard)], pass_fds=[heard], env=plain,
                              stdout=subprocess.DEVNULL, stderr=open(f"{scratch}/client.log", "w"))
    os.close(heard)
    memory, descriptors = [], []
    try:
        with os.fdopen(ready) as lines:
            for line in lines:
                if run.poll() is not None:
                    break
                time.sleep(0.2)  # the run notices that it was left
                memory.append(resident_mb(run.pid))
                descriptors.append(len(os.listdir(f"/proc/{run.pid}/fd")))
                if len(memory) in (1, 10, 20, count // 2) or len(memory) % 40 == 0 or len(memory) == count:
                    print(f"{len(memory)} connections, {line.strip()} cells: {memory[-1]:.1f} MB, {descriptors[-1]} descriptors", flush=True)
        alive = run.poll() is None
    finally:
        for process in (client, run):
            process.kill()
            process.wait()
    if not alive:
        sys.exit(f"FAILED: the run has ended: {open(f'{scratch}/run.log').read()}")
    if len(memory) != count:
        sys.exit(f"FAILED: {len(memory)} connections of {count}: {open(f'{scratch}/client.log').read()}")
    if len(set(descriptors[count // 2:])) != 1 or descriptors[-1] > descriptors[0]:
        sys.exit(f"FAILED: open descriptors: {descriptors}")
    if memory[-1] > (1 + GROWTH) * memory[count // 2]:
        sys.exit(f"FAILED: {memory[count // 2]:.1f} MB after half of the connections, {memory[-1]:.1f} MB after all")


if sys.argv[1] == "--watch":
    watch(*map(int, sys.argv[2:5]))
else:
    main(*sys.argv[1:3], int(sys.argv[3]))
