"""A ParaView without windows that pauses a run and never lets it go on.

usage: pvpython live_pause_client.py PORT FILE
FILE is written when it has asked for the pause. It ends by a signal, or after two minutes.
"""

import sys
import time

from paraview import live

PORT, FILE = int(sys.argv[1]), sys.argv[2]
END = time.time() + 120.0

link = live.ConnectToCatalyst("localhost", PORT)
proxies = link.GetInsituProxyManager
paused = False
while time.time() < END:
    live.ProcessServerNotifications()
    if not paused and proxies() and proxies().GetNumberOfProxies("sources") > 0:
        live.PauseCatalyst(link, True)
        paused = True
        with open(FILE, "w", encoding="utf-8"):
            pass
    time.sleep(0.02)
