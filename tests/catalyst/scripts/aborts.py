# script-version: 2.0
"""Ends as ParaView does where it meets what it cannot bear."""
import os

from paraview.simple import TrivialProducer

surface = TrivialProducer(registrationName="surface")


def catalyst_execute(info):
    os.abort()
